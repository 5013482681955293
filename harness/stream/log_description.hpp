// The description of a log: its log.yaml, and which optional files it has.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/stream/stream.hpp"

namespace harness {

/// The noise of the landmark sensor. The two parts of the range noise are added in quadrature.
struct SensorNoise {
  double range_sd = 0.0;        // [m]
  double range_sd_per_m = 0.0;  // [-]
  double bearing_sd = 0.0;      // [rad]
};

/// The covariance of an observation at this range, (2 x 2) of [range bearing].
Eigen::Matrix2d covariance(const SensorNoise& noise, double range);

struct LogDescription {
  std::string name;
  seif::Pose2 T_robot_sensor;
  SensorNoise noise;
  std::optional<double> max_range;  // [m] of the landmark sensor; empty: not known
  double start_t = 0.0;             // [s] start of the first odometry increment
  seif::PoseEstimate start;         // T_world_robot at start_t, as the robot believes
  bool known_association = true;
  /// [s] between true poses that are further apart the truth is not known
  double longest_truth_gap = std::numeric_limits<double>::infinity();

  // What the log holds besides odometry and observations.
  bool has_truth = false;
  bool has_wheel_angles = false;                       // the truth has wheel angles
  bool has_true_ids = false;                           // of observations with a withheld id or a false
                                                       // detection
  std::optional<TruePose> true_start;                  // true pose at start_t
  std::optional<std::vector<TrueLandmark>> landmarks;  // sorted by id
};

/// The description as the text of a log.yaml.
std::string to_yaml(const LogDescription& description);

/// Reads log.yaml into `description`; what other files give is left unchanged. Throws BadInput with every
/// problem of the file, one on each line.
void read_yaml(const std::filesystem::path& file, LogDescription& description);

/// Reads longest_truth_gap from a log.yaml; infinity if there is no file. Throws BadInput.
double longest_truth_gap(const std::filesystem::path& file);

}  // namespace harness
