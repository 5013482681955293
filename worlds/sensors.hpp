// The sensors of the robot, and what is known of its start.
#pragma once

#include "worlds/degree.hpp"
#include "worlds/placement.hpp"

namespace worlds {

/// Wheel encoders. The filters believe the nominal radius and track; the systematic errors are what they do
/// not know.
struct Encoders {
  int rate = 20;                    // [Hz] of odometry
  int ticks_per_revolution = 4096;  // [-] 0: no quantisation
  double distance_sd = 0.005;       // [m/sqrt(m)] random error of one wheel after 1 m rolled
  double diameter_ratio = 1.0;  // [-] Borenstein's E_d: right over left wheel diameter, actual over assumed
  double track_ratio = 1.0;     // [-] Borenstein's E_b: actual over assumed track
  double diameter_ratio_sd = 0.0;  // [-] of the part of E_d that is drawn from the seed
  double track_ratio_sd = 0.0;     // [-] of the part of E_b that is drawn from the seed
  bool calibrated = false;         // no systematic error, whatever the four values above say
};

enum class LandmarkIds { known, hidden };

/// A range-bearing sensor that knows which landmark it sees, unless it is told not to.
struct LandmarkSensor {
  int rate = 5;                      // [Hz] of scans
  Placement mount;                   // T_robot_sensor
  double max_range = 8.0;            // [m]
  double fov = 360 * degree;         // [rad] full angle, centred on the sensor's x
  double range_sd = 0.05;            // [m]
  double range_sd_per_m = 0.0;       // [-] grows with range, added in quadrature
  double bearing_sd = 0.5 * degree;  // [rad]
  double miss_probability = 0.0;     // [-] that a visible landmark is not reported
  double false_detections = 0.0;     // [-] mean number in a scan (Poisson), with ids that no landmark has
  double misread_probability = 0.0;  // [-] that an observation bears another landmark's id
  LandmarkIds ids = LandmarkIds::known;
};

/// The start estimate is drawn from N(truth, P0), P0 diagonal.
struct StartEstimate {
  double x_sd = 0.05;                // [m]
  double y_sd = 0.05;                // [m]
  double heading_sd = 0.5 * degree;  // [rad]
};

}  // namespace worlds
