// Wheel odometry as on a real robot: joint angles, ticks, assumed geometry, arcs.
//
// Systematic errors follow Borenstein and Feng, "UMBmark: a method for measuring, comparing and correcting
// dead-reckoning errors in mobile robots", 1994:
//   E_d = D_right / D_left (actual; the robot assumes equal ones)      E_b = b_actual / b_assumed
// In the simulation the true wheels are equal and the true track is used, so the errors lie in the values that
// the robot assumes. The assumed mean diameter is right:
//   r_assumed_left = r / c_l,  c_l = 2 / (E_d + 1);   r_assumed_right = r / c_r,  c_r = 2 / (1/E_d + 1);
//   b_assumed = b / E_b.
// So with E_b > 1 every turn is read too large by the factor E_b; with E_d > 1 a straight line is read as a
// curve to the right.
#pragma once

#include <cstdint>
#include <random>

#include "seif/types.hpp"
#include "sensors/wheel_arc.hpp"

namespace sensors {

struct WheelEncoderOptions {
  double wheel_radius = 0.1;        // [m] true radius of both wheels
  double track = 0.4;               // [m] true track
  int ticks_per_revolution = 4096;  // [-] 0: no quantisation
  double distance_sd = 0.0;         // [m/sqrt(m)] random error of one wheel after 1 m rolled
  double diameter_ratio = 1.0;      // [-] E_d: actual right over left diameter; the robot assumes 1
  double track_ratio = 1.0;         // [-] E_b: actual over assumed track
};

/// Turns true joint angles into odometry with its covariance. The covariance includes only the random errors;
/// it cannot include systematic errors and slip.
class WheelEncoders {
 public:
  /// The joint angles are taken as zero at the start. Throws std::invalid_argument if a length or ratio is not
  /// positive, or noise or ticks are negative.
  WheelEncoders(const WheelEncoderOptions& options, std::mt19937_64 random);

  /// The increment since the last reading. Arguments are the time and the unwrapped angles since the start. [s,
  /// rad, rad] The covariance has at most rank 2: two wheels, three coordinates. Throws std::invalid_argument
  /// if an angle is not finite.
  seif::Odometry read(double t, double left_angle, double right_angle);

 private:
  struct Wheel {
    double assumed_radius = 0.0;  // [m]
    double angle = 0.0;           // [rad] true angle at the last reading
    double error = 0.0;           // [rad] sum of the random errors so far
    double measured = 0.0;        // [rad] read so far: whole ticks; the remainder is carried over
  };

  double roll(Wheel& wheel, double angle);
  double variance(const Wheel& wheel, double distance) const;

  WheelEncoderOptions options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> standard_normal_;
  double tick_ = 0.0;           // [rad] angle of one tick; 0: no quantisation
  double assumed_track_ = 0.0;  // [m]
  Wheel left_;
  Wheel right_;
};

}  // namespace sensors
