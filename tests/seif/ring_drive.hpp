// A kinematic drive for tests and benchmarks; the density of landmarks is the same for any number of them.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "seif/estimator.hpp"

namespace seif::test {

const inline StageDone ignore = [](Stage) {};

#ifdef __SANITIZE_ADDRESS__
inline constexpr bool under_sanitizer = true;  // tens of times slower, so long drives are shortened
#else
inline constexpr bool under_sanitizer = false;
#endif

/// A robot that drives around a ring again and again, with landmarks 1.5 m apart on both sides. It sees those
/// within 4 m.
class RingDrive {
 public:
  RingDrive(int landmarks, unsigned seed) : landmarks_(landmarks), random_(seed) {
    radius_ = 1.5 * (landmarks / 2) / (2 * std::numbers::pi);
    scan_.observations.reserve(20);
  }

  EstimatorSetup setup() const {
    return {.start = {.mean = truth(),
                      .covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal().toDenseMatrix()},
            .T_robot_sensor = {},
            .random = std::mt19937_64(5)};
  }

  /// Drives half a metre and takes a scan: odometry() and scan() then return these.
  void advance() {
    const Pose2 before = truth();
    along_ += 0.5 / radius_;
    odometry_ = {.t = ++t_, .T_previous_current = inverse(before) * truth()};
    odometry_.covariance.diagonal() << 1e-4, 1e-6, 1e-5;
    odometry_.T_previous_current.x += 1e-2 * noise_(random_);
    odometry_.T_previous_current.theta += 3e-3 * noise_(random_);

    scan_.t = t_;
    scan_.observations.clear();
    const auto here = static_cast<int>(along_ * radius_ / 1.5);
    for (int k = here - 4; k <= here + 4; ++k) {
      for (const int side : {0, 1}) see(((k * 2 + side) % landmarks_ + landmarks_) % landmarks_);
    }
  }

  const Odometry& odometry() const { return odometry_; }
  const Scan& scan() const { return scan_; }

  void step(Estimator& filter) {
    advance();
    filter.motion_update(odometry_);
    filter.measurement_update(scan_, ignore);
  }

  /// [x y theta] of an estimate minus the truth. [m, m, rad]
  Eigen::Vector3d error_of(const Pose2& pose) const {
    const Pose2 true_pose = truth();
    return {pose.x - true_pose.x, pose.y - true_pose.y, wrap_angle(pose.theta - true_pose.theta)};
  }

  int steps_for_a_round() const { return static_cast<int>(std::ceil(2 * std::numbers::pi * radius_ / 0.5)); }

 private:
  Pose2 truth() const {
    return {radius_ * std::cos(along_), radius_ * std::sin(along_),
            wrap_angle(along_ + std::numbers::pi / 2)};
  }

  void see(int landmark) {
    const double angle = (landmark / 2) * 1.5 / radius_;
    const double r = radius_ + (landmark % 2 == 0 ? 1.5 : -1.5);
    const Eigen::Vector2d p = inverse(truth()) * Eigen::Vector2d(r * std::cos(angle), r * std::sin(angle));
    if (p.norm() > 4.0) return;
    Observation z{.landmark = landmark, .range = p.norm() + 0.02 * noise_(random_)};
    z.bearing = wrap_angle(std::atan2(p.y(), p.x()) + 0.01 * noise_(random_));
    z.covariance.diagonal() << 4e-4, 1e-4;
    scan_.observations.push_back(z);
  }

  int landmarks_;
  double radius_;
  double along_ = 0.0;
  double t_ = 0.0;
  Odometry odometry_;
  Scan scan_;
  std::mt19937_64 random_;
  std::normal_distribution<double> noise_;
};

}  // namespace seif::test
