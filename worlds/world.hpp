// A world: one scenario, complete and checked, as plain values. SI units and radians.
// World frame: x east, y north; the ground is centred on the origin. Yaw counter-clockwise.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "worlds/drive.hpp"
#include "worlds/estimator_choice.hpp"
#include "worlds/fault.hpp"
#include "worlds/film.hpp"
#include "worlds/radio.hpp"
#include "worlds/robot.hpp"
#include "worlds/sensors.hpp"
#include "worlds/solids.hpp"
#include "worlds/team.hpp"

namespace worlds {

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
  /// Empty: there is one robot, `robot`. Otherwise these are all robots, and what each has of its own replaces the
  /// value of the same name above.
  std::vector<TeamRobot> robots;
  Radio radio;  // of the robots of a team
};

}  // namespace worlds
