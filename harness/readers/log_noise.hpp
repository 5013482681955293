// The noise of a robot's odometry and landmark sensor, for logs that do not state it row by row.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/stream/log_description.hpp"
#include "seif/types.hpp"
#include "worlds/fields.hpp"

namespace harness {

/// Errors that grow like a random walk: their variances add up over distance and turns, however the motion is cut
/// into increments.
struct OdometryNoise {
  double distance_sd_per_sqrt_m = 0.0;  // [m/sqrt(m)] along the way
  double sideways_sd_per_sqrt_m = 0.0;  // [m/sqrt(m)] across it
  double turn_sd_per_sqrt_m = 0.0;      // [rad/sqrt(m)]
  double turn_sd_per_sqrt_rad = 0.0;    // [-] sqrt(rad)
};

/// Nothing: the values of the log are used.
struct LogNoise {
  std::optional<OdometryNoise> odometry;
  std::optional<SensorNoise> sensor;
};

/// The covariance of an increment, in its own frame. (3 x 3) [m, rad]
Eigen::Matrix3d covariance(const OdometryNoise& noise, const seif::Pose2& T_previous_current);

/// The choices of the command line: a file, and `noise.key=value`, which overrides the file.
struct NoiseChoices {
  std::filesystem::path file = {};  // empty: none
  std::vector<std::string> overrides = {};

  bool empty() const { return file.empty() && overrides.empty(); }
};

/// `fallback` with the choices applied. A key of the odometry sets all of the odometry's noise, and a key of the
/// sensor all of the sensor's, with the fallback's values for the other keys. Throws BadInput.
LogNoise read_noise(const NoiseChoices& choices, const LogNoise& fallback);

/// As read_noise reads it from a file.
std::string to_yaml(const LogNoise& noise);

}  // namespace harness
