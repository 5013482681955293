// The description of a log: log.yaml, and which of the optional files exist.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/stream/stream.hpp"

namespace harness {

/// The noise of the landmark sensor. The parts of the range are added in quadrature.
struct SensorNoise {
  double range_sd = 0.0;        // [m]
  double range_sd_per_m = 0.0;  // [-]
  double bearing_sd = 0.0;      // [rad]
};

/// The covariance of an observation at this range. (2 x 2) of [range bearing]
Eigen::Matrix2d covariance(const SensorNoise& noise, double range);

struct LogDescription {
  std::string name;
  seif::Pose2 T_robot_sensor;
  SensorNoise noise;
  std::optional<double> max_range;  // [m] of the landmark sensor, where it is known
  double start_t = 0.0;             // [s] where the first odometry increment begins
  seif::PoseEstimate start;         // T_world_robot then, as the robot believes
  bool known_association = true;
  /// [s] Between true poses that are further apart there is no truth.
  double longest_truth_gap = std::numeric_limits<double>::infinity();

  // What the log holds besides odometry and observations.
  bool has_truth = false;
  bool has_wheel_angles = false;                       // in the truth
  bool has_true_ids = false;                           // for observations whose landmark is withheld or false
  std::optional<TruePose> true_start;                  // the truth at start_t
  std::optional<std::vector<TrueLandmark>> landmarks;  // by ascending id
};

/// log.yaml as text.
std::string to_yaml(const LogDescription& description);

/// Reads log.yaml. Throws BadInput with every problem in it, a line for each. Fields that come from
/// other files of the log stay unchanged.
void read_yaml(const std::filesystem::path& file, LogDescription& description);

/// What the log.yaml says of that; without a file, infinity. Throws BadInput.
double longest_truth_gap(const std::filesystem::path& file);

}  // namespace harness
