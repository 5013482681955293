// The noise of a robot's odometry and landmark sensor, for logs that do not give it in each row.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/stream/log_description.hpp"
#include "seif/types.hpp"
#include "worlds/fields.hpp"

namespace harness {

/// Errors grow like a random walk: the variances add up over distance and turns, however the motion is
/// divided into increments.
struct OdometryNoise {
  double distance_sd_per_sqrt_m = 0.0;  // [m/sqrt(m)] along the direction of motion
  double sideways_sd_per_sqrt_m = 0.0;  // [m/sqrt(m)] across the direction of motion
  double turn_sd_per_sqrt_m = 0.0;      // [rad/sqrt(m)]
  double turn_sd_per_sqrt_rad = 0.0;    // [-] sqrt(rad)
};

/// An empty part: as recorded in the log.
struct LogNoise {
  std::optional<OdometryNoise> odometry;
  std::optional<SensorNoise> sensor;
};

/// The covariance of an increment, in the frame of its start. (3 x 3) [m, rad]
Eigen::Matrix3d covariance(const OdometryNoise& noise, const seif::Pose2& T_previous_current);

/// The noise options of the command line: a file, and `noise.key=value`, which has precedence.
struct NoiseChoices {
  std::filesystem::path file = {};  // empty: none
  std::vector<std::string> overrides = {};

  bool empty() const { return file.empty() && overrides.empty(); }
};

/// `fallback` with the choices applied. One key of the odometry replaces all of the odometry's recorded
/// noise, and one key of the sensor all of the sensor's; the other values are then the fallback's. Throws
/// BadInput.
LogNoise read_noise(const NoiseChoices& choices, const LogNoise& fallback);

/// The text of a file that read_noise() reads.
std::string to_yaml(const LogNoise& noise);

}  // namespace harness
