#include "sim/planar_geometry.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sim {

namespace {

double distance_to_point(const Segment& way, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = way.end - way.start;
  const double length_squared = along.squaredNorm();
  const double share =
      length_squared > 0.0 ? std::clamp((point - way.start).dot(along) / length_squared, 0.0, 1.0) : 0.0;
  return (way.start + share * along - point).norm();
}

/// Distance from a point to the rectangle of the given half size around the origin; 0 inside.
double distance_to_rectangle(const Eigen::Vector2d& point, const Eigen::Vector2d& half_size) {
  return (point.cwiseAbs() - half_size).cwiseMax(0.0).norm();
}

/// Whether the path meets the rectangle around the origin: whether a part of it is left after clipping it by
/// the rectangle's two slabs.
bool meets_rectangle(const Segment& way, const Eigen::Vector2d& half_size) {
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double start = way.start[axis];
    const double along = way.end[axis] - start;
    const double half = half_size[axis];
    if (along == 0.0) {
      if (std::abs(start) > half) {
        return false;
      }
      continue;
    }
    const double first = (-half - start) / along;
    const double second = (half - start) / along;
    enter = std::max(enter, std::min(first, second));
    leave = std::min(leave, std::max(first, second));
  }
  return enter <= leave;
}

}  // namespace

Eigen::Vector2d direction(double heading) { return {std::cos(heading), std::sin(heading)}; }

double heading_of(const Eigen::Vector2d& vector) {
  const double heading = std::atan2(vector.y(), vector.x());
  // atan2(-0, -1) is -pi, which the convention excludes.
  return heading <= -std::numbers::pi ? std::numbers::pi : heading;
}

double distance(const Segment& way, const Disk& disk) {
  return std::max(0.0, distance_to_point(way, disk.centre) - disk.radius);
}

double distance(const Segment& way, const Rectangle& rectangle) {
  const Eigen::Rotation2Dd R_box_world(-rectangle.heading);
  const Segment way_box{R_box_world * (way.start - rectangle.centre),
                        R_box_world * (way.end - rectangle.centre)};
  const Eigen::Vector2d& half = rectangle.half_size;
  if (meets_rectangle(way_box, half)) {
    return 0.0;
  }
  // Two separate convex polygons are nearest at a corner of one of them.
  double nearest =
      std::min(distance_to_rectangle(way_box.start, half), distance_to_rectangle(way_box.end, half));
  for (const double x : {-half.x(), half.x()}) {
    for (const double y : {-half.y(), half.y()}) {
      nearest = std::min(nearest, distance_to_point(way_box, {x, y}));
    }
  }
  return nearest;
}

}  // namespace sim
