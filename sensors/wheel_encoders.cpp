#include "sensors/wheel_encoders.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sensors {

namespace {

void check(const WheelEncoderOptions& options) {
  if (!(options.wheel_radius > 0.0 && options.track > 0.0)) {
    throw std::invalid_argument("wheel encoders: wheel radius and track must be positive");
  }
  if (!(options.diameter_ratio > 0.0 && options.track_ratio > 0.0)) {
    throw std::invalid_argument("wheel encoders: diameter ratio and track ratio must be positive");
  }
  if (!(options.distance_sd >= 0.0) || options.ticks_per_revolution < 0) {
    throw std::invalid_argument("wheel encoders: noise and ticks per revolution must not be negative");
  }
}

}  // namespace

WheelEncoders::WheelEncoders(const WheelEncoderOptions& options, std::mt19937_64 random)
    : options_(options), random_(random) {
  check(options);
  const double E_d = options.diameter_ratio;
  left_.assumed_radius = options.wheel_radius * (E_d + 1.0) / 2.0;
  right_.assumed_radius = options.wheel_radius * (1.0 / E_d + 1.0) / 2.0;
  assumed_track_ = options.track / options.track_ratio;
  if (options.ticks_per_revolution > 0) {
    tick_ = 2.0 * std::numbers::pi / options.ticks_per_revolution;
  }
}

seif::Odometry WheelEncoders::read(double t, double left_angle, double right_angle) {
  if (!std::isfinite(left_angle) || !std::isfinite(right_angle)) {
    throw std::invalid_argument("wheel encoders: a joint angle is not finite");
  }
  const double left = roll(left_, left_angle);
  const double right = roll(right_, right_angle);
  const WheelArc arc = wheel_arc({left, right}, assumed_track_);
  const Eigen::Vector2d variances(variance(left_, left), variance(right_, right));

  seif::Odometry odometry;
  odometry.t = t;
  odometry.T_previous_current = arc.T_start_end;
  odometry.covariance = arc.J_arc_wrt_wheels * variances.asDiagonal() * arc.J_arc_wrt_wheels.transpose();
  return odometry;
}

/// Moves the wheel to its new true angle. Returns the distance that the robot believes it rolled since the last
/// reading. [m]
double WheelEncoders::roll(Wheel& wheel, double angle) {
  const double distance = options_.wheel_radius * std::abs(angle - wheel.angle);
  wheel.error +=
      options_.distance_sd * std::sqrt(distance) / options_.wheel_radius * standard_normal_(random_);
  wheel.angle = angle;
  const double read = wheel.angle + wheel.error;
  const double measured = tick_ > 0.0 ? tick_ * std::floor(read / tick_) : read;
  const double increment = measured - wheel.measured;
  wheel.measured = measured;
  return wheel.assumed_radius * increment;
}

/// The variance of the distance that a wheel rolled: a random walk along the way, and the rounding to a tick,
/// as uniform noise.
double WheelEncoders::variance(const Wheel& wheel, double distance) const {
  const double tick_length = tick_ * wheel.assumed_radius;
  return options_.distance_sd * options_.distance_sd * std::abs(distance) + tick_length * tick_length / 12.0;
}

}  // namespace sensors
