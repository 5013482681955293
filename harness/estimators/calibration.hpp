// Estimates the noise of odometry and sensor from logs with known landmarks, by maximum likelihood.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/readers/log_noise.hpp"
#include "harness/stream/recorded_log.hpp"

namespace harness {

/// The data of a log that localisation on a known map needs.
struct CalibrationLog {
  struct Event {
    bool is_motion = false;
    seif::Pose2 T_previous_current;  // for a motion
    seif::Observation observation;   // otherwise; its covariance is not used
    Eigen::Vector2d p_world_landmark = Eigen::Vector2d::Zero();
    bool begins_scan = false;
  };
  seif::PoseEstimate start;
  seif::Pose2 T_robot_sensor;
  std::vector<Event> events;
  std::int64_t observations = 0;
};

/// Reads a log to its end. Throws BadInput if the log has no true landmarks, or if none of them was seen.
CalibrationLog read_for_calibration(RecordedLog& log);

/// The noise parameters, in this order: along, across, heading by distance, heading by turns; range, range by
/// its length, bearing.
inline constexpr int noise_parameters = 7;
using NoiseValues = std::array<double, noise_parameters>;

NoiseValues values_of(const LogNoise& noise);
LogNoise noise_of(const NoiseValues& values);

struct Calibration {
  NoiseValues values = {};           // [m, rad] standard deviations; 0: cannot be distinguished from zero
  NoiseValues standard_errors = {};  // standard errors of `values`
  std::int64_t observations = 0;
  std::int64_t outliers = 0;  // observations that are more likely outliers
};

/// Maximises the likelihood of all innovations of an extended Kalman filter of the pose on the true map. An
/// observation is an outlier with a probability of 1 %, and is then anywhere. Throws std::runtime_error if no
/// maximum is found.
Calibration calibrate(const std::vector<CalibrationLog>& logs, const LogNoise& guess);

/// The text of a noise file, with the standard errors as comments.
std::string to_yaml(const Calibration& calibration);

}  // namespace harness
