// The sensors of the robot, and the uncertainty of its start.
#pragma once

#include "worlds/degree.hpp"
#include "worlds/placement.hpp"

namespace worlds {

/// Wheel encoders. The filters use the nominal radius and track; they do not know the systematic errors.
struct Encoders {
  int rate = 20;                    // [Hz] of odometry
  int ticks_per_revolution = 4096;  // [-] 0: no quantisation
  double distance_sd = 0.005;       // [m/sqrt(m)] random error of one wheel after 1 m rolled
  double diameter_ratio = 1.0;  // [-] Borenstein's E_d: right over left wheel diameter, actual over assumed
  double track_ratio = 1.0;     // [-] Borenstein's E_b: actual over assumed track
  double diameter_ratio_sd = 0.0;  // [-] of the random part of E_d, drawn from the seed
  double track_ratio_sd = 0.0;     // [-] of the random part of E_b, drawn from the seed
  bool calibrated = false;         // true: no systematic error; the four values above are ignored
};

enum class LandmarkIds { known, hidden };

inline constexpr double largest_range_sd = 1e3;  // [m] at any range; logs allow no more

/// A range-bearing sensor. It names the landmark that it sees, unless `ids` is hidden.
struct LandmarkSensor {
  int rate = 5;                      // [Hz] of scans
  Placement mount;                   // T_robot_sensor
  double max_range = 8.0;            // [m]
  double fov = 360 * degree;         // [rad] field of view: full angle, centred on the sensor's x
  double range_sd = 0.05;            // [m]
  double range_sd_per_m = 0.0;       // [-] part of the sd that grows with range, added in quadrature
  double bearing_sd = 0.5 * degree;  // [rad]
  double miss_probability = 0.0;     // [-] of a visible landmark not being reported
  double false_detections = 0.0;     // [-] mean number in a scan (Poisson), with ids that no landmark has
  double misread_probability = 0.0;  // [-] of an observation having another landmark's id
  LandmarkIds ids = LandmarkIds::known;
};

/// The start estimate is drawn from N(truth, P0), P0 diagonal.
struct StartEstimate {
  double x_sd = 0.05;                // [m]
  double y_sd = 0.05;                // [m]
  double heading_sd = 0.5 * degree;  // [rad]
};

}  // namespace worlds
