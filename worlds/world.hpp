// A world: one scenario, complete and checked, as plain values. SI units and radians.
// World frame: x east, y north; the ground is centred on the origin. Yaw counter-clockwise.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "worlds/drive.hpp"
#include "worlds/fault.hpp"
#include "worlds/film.hpp"
#include "worlds/robot.hpp"
#include "worlds/sensors.hpp"
#include "worlds/solids.hpp"

namespace worlds {

using OptionValue = std::variant<bool, std::int64_t, double, std::string>;

/// A factor for the noise that an estimator assumes is at most this, and at least its inverse. [-]
inline constexpr double largest_sd_factor = 1e6;

/// An estimator to run, under its own name. Only the estimator knows the meaning of its options.
struct EstimatorChoice {
  std::string name;
  std::string type;                    // the kind; by default the name
  std::string library;                 // path of the plug-in that has the type; empty: the program knows it
  double odometry_sd_factor = 1.0;     // [-] odometry noise that it assumes / noise that the sensor reports
  double observation_sd_factor = 1.0;  // [-] the same for observations
  std::map<std::string, OptionValue> options;  // a value for every option of the type
};

struct Scoring {
  double interval = 10.0;     // [s] between two scorings of consistency
  int landmark_sample = 200;  // [-] landmarks scored for consistency, at most
  double rpe_interval = 1.0;  // [s] over which the relative pose error is measured
};

struct World {
  std::string name;
  std::string description;
  std::uint64_t seed = 1;
  double duration = 60.0;                                 // [s]
  Eigen::Vector2d ground_size = Eigen::Vector2d(40, 40);  // [m] centred on the origin
  Robot robot;
  Physics physics;
  std::vector<Landmark> landmarks;  // a landmark's index is its id
  std::vector<Box> boxes;
  std::vector<Wall> walls;
  Drive drive;
  Encoders encoders;
  LandmarkSensor landmark_sensor;
  std::vector<Fault> faults;
  StartEstimate start_estimate;
  std::vector<EstimatorChoice> estimators;  // in the order of the file
  Scoring scoring;
  Film film;
};

}  // namespace worlds
