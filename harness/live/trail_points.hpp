// The points of a path since they were last handed over, in bounded memory.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "harness/film/trail.hpp"
#include "harness/live/running_figures.hpp"
#include "harness/live/snapshot.hpp"

namespace harness {

class TrailPoints {
 public:
  /// Leaves out a point that is nearer than trail_spacing to the one before.
  void add(double x, double y) {
    if (last_ && (*last_ - Eigen::Vector2d(x, y)).norm() < trail_spacing) return;
    last_ = {x, y};
    if (points_.size() >= most) halve(points_);
    points_.push_back({static_cast<float>(x), static_cast<float>(y)});
  }

  void hand_over(std::vector<LivePoint>& points) {
    points.swap(points_);
    points_.clear();
  }

 private:
  static constexpr std::size_t most = 1024;  // [-]

  std::optional<Eigen::Vector2d> last_;  // [m]
  std::vector<LivePoint> points_;
};

}  // namespace harness
