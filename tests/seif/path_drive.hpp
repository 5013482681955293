// A kinematic drive along any path, among landmarks at any places.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "seif/estimator.hpp"

namespace seif::test {

using Points = std::vector<Eigen::Vector2d>;

/// Drives half a metre per step, from corner to corner, and sees up to 4 m. Sometimes a landmark is missed.
class PathDrive {
 public:
  PathDrive(Points landmarks, Points corners, unsigned seed)
      : landmarks_(std::move(landmarks)), corners_(std::move(corners)), random_(seed) {
    turn_to_next();
  }

  EstimatorSetup setup() const {
    return {.start = {.mean = truth_,
                      .covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal().toDenseMatrix()},
            .T_robot_sensor = {},
            .random = std::mt19937_64(5)};
  }

  bool at_end() const { return next_ >= corners_.size(); }

  /// Drives one step: odometry() and scan() then return it. Not to be called at the end.
  void advance() {
    const Pose2 before = truth_;
    const Eigen::Vector2d to_go = corners_[next_] - Eigen::Vector2d(truth_.x, truth_.y);
    const double step = std::min(0.5, to_go.norm());
    truth_.x += step * std::cos(truth_.theta);
    truth_.y += step * std::sin(truth_.theta);
    if (to_go.norm() <= 0.5) turn_to_next();
    odometry_ = {.t = ++t_, .T_previous_current = inverse(before) * truth_};
    odometry_.covariance.diagonal() << 1e-4, 1e-6, 1e-5;
    odometry_.T_previous_current.x += 1e-2 * noise_(random_);
    odometry_.T_previous_current.theta += 3e-3 * noise_(random_);
    look();
  }

  const Odometry& odometry() const { return odometry_; }
  const Scan& scan() const { return scan_; }
  const Pose2& truth() const { return truth_; }  // T_world_robot

 private:
  void turn_to_next() {
    const Eigen::Vector2d here = next_ == 0 ? corners_.front() : Eigen::Vector2d(truth_.x, truth_.y);
    ++next_;
    if (at_end()) return;
    const Eigen::Vector2d way = corners_[next_] - here;
    truth_ = {here.x(), here.y(), std::atan2(way.y(), way.x())};
  }

  void look() {
    scan_.t = t_;
    scan_.observations.clear();
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      const Eigen::Vector2d p = inverse(truth_) * landmarks_[i];
      if (p.norm() > 4.0 || p.norm() < 0.2 || overlooked_(random_)) continue;
      Observation z{.landmark = static_cast<LandmarkId>(i), .range = p.norm() + 0.02 * noise_(random_)};
      z.bearing = wrap_angle(std::atan2(p.y(), p.x()) + 0.01 * noise_(random_));
      z.covariance.diagonal() << 4e-4, 1e-4;
      scan_.observations.push_back(z);
    }
  }

  Points landmarks_;
  Points corners_;
  std::size_t next_ = 0;
  Pose2 truth_;
  double t_ = 0.0;
  Odometry odometry_;
  Scan scan_;
  std::mt19937_64 random_;
  std::normal_distribution<double> noise_;
  std::bernoulli_distribution overlooked_{0.15};
};

/// Landmarks on both sides of a path, about two metres apart, and at least one metre from each other.
inline Points landmarks_along(const Points& corners, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  Points landmarks;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Eigen::Vector2d way = corners[i] - corners[i - 1];
    const Eigen::Vector2d along = way.normalized();
    const Eigen::Vector2d across(-along.y(), along.x());
    for (double s = 0.0; s < way.norm(); s += 2.0) {
      for (const double side : {-1.5, 1.5}) {
        const Eigen::Vector2d p =
            corners[i - 1] + (s + jitter(random)) * along + (side + jitter(random)) * across;
        const auto is_near = [&](const Eigen::Vector2d& other) { return (other - p).norm() < 1.0; };
        if (std::ranges::none_of(landmarks, is_near)) landmarks.push_back(p);
      }
    }
  }
  return landmarks;
}

}  // namespace seif::test
