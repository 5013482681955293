// Wheel odometry as robots have it: joint angles, ticks, assumed geometry, arcs.
//
// Systematic errors follow Borenstein and Feng, "UMBmark: a method for measuring, comparing and correcting
// dead-reckoning errors in mobile robots", 1994:
//   E_d = D_right / D_left (actual; the robot assumes equal ones)      E_b = b_actual / b_assumed
// The wheels that really roll are equal and the track is the real one, so it is the assumption that is off,
// with the mean diameter assumed rightly:
//   r_assumed_left = r / c_l,  c_l = 2 / (E_d + 1);   r_assumed_right = r / c_r,  c_r = 2 / (1/E_d + 1);
//   b_assumed = b / E_b.
// So E_b > 1 reads every turn too large by the factor E_b; E_d > 1 reads a straight line as a curve to the
// right.
#pragma once

#include <cstdint>
#include <random>

#include "seif/types.hpp"
#include "sensors/wheel_arc.hpp"

namespace sensors {

struct WheelEncoderOptions {
  double wheel_radius = 0.1;        // [m] of both wheels, as they really are
  double track = 0.4;               // [m] as it really is
  int ticks_per_revolution = 4096;  // [-] 0: no quantisation
  double distance_sd = 0.0;         // [m/sqrt(m)] random error of one wheel after 1 m rolled
  double diameter_ratio = 1.0;      // [-] E_d: actual right over left diameter, where equal ones are assumed
  double track_ratio = 1.0;         // [-] E_b: actual over assumed track
};

/// Turns true joint angles into odometry with its covariance. The covariance knows of the random errors
/// alone; systematic ones and slip it cannot know.
class WheelEncoders {
 public:
  /// The joint angles are taken as zero at the start. Throws std::invalid_argument for lengths and ratios
  /// that are not positive, or negative noise or ticks.
  WheelEncoders(const WheelEncoderOptions& options, std::mt19937_64 random);

  /// The increment since the last reading. Angles are unwrapped, since the start. [s, rad, rad]
  /// Its covariance has rank 2 at most: two wheels, three coordinates.
  /// Throws std::invalid_argument for an angle that is not finite.
  seif::Odometry read(double t, double left_angle, double right_angle);

 private:
  struct Wheel {
    double assumed_radius = 0.0;  // [m]
    double angle = 0.0;           // [rad] true, at the last reading
    double error = 0.0;           // [rad] random error gathered so far
    double measured = 0.0;        // [rad] read so far: whole ticks, so that the remainder is carried
  };

  double roll(Wheel& wheel, double angle);
  double variance(const Wheel& wheel, double distance) const;

  WheelEncoderOptions options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> standard_normal_;
  double tick_ = 0.0;           // [rad] of one tick; 0: no quantisation
  double assumed_track_ = 0.0;  // [m]
  Wheel left_;
  Wheel right_;
};

}  // namespace sensors
