#include "worlds/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace worlds {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// p in the rectangle's own frame.
Eigen::Vector2d to_own_frame(const Eigen::Vector2d& p_world, const Rectangle& rectangle) {
  const Eigen::Vector2d offset = p_world - rectangle.centre;
  return {rectangle.axis.dot(offset), cross(rectangle.axis, offset)};
}

/// Whether the segments cross at a point in the interior of both.
bool cross_properly(const Segment& a, const Segment& b) {
  const Eigen::Vector2d along_a = a.to - a.from;
  const Eigen::Vector2d along_b = b.to - b.from;
  const bool a_splits_b = cross(along_a, b.from - a.from) * cross(along_a, b.to - a.from) < 0;
  const bool b_splits_a = cross(along_b, a.from - b.from) * cross(along_b, a.to - b.from) < 0;
  return a_splits_b && b_splits_a;
}

}  // namespace

Rectangle rectangle(const Box& box) {
  return {box.centre.position, {std::cos(box.centre.heading), std::sin(box.centre.heading)}, 0.5 * box.size};
}

Rectangle rectangle(const Segment& segment, double thickness) {
  const Eigen::Vector2d along = segment.to - segment.from;
  const double extent = along.norm();
  return {0.5 * (segment.from + segment.to),
          extent > 0 ? Eigen::Vector2d(along / extent) : Eigen::Vector2d(Eigen::Vector2d::UnitX()),
          {0.5 * extent, 0.5 * thickness}};
}

std::vector<Segment> legs(const std::vector<Eigen::Vector2d>& points, bool closed) {
  std::vector<Segment> result;
  const std::size_t count = points.size() < 2 ? 0 : points.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < count; ++i) {
    const Segment leg{points[i], points[(i + 1) % points.size()]};
    if (leg.from != leg.to) result.push_back(leg);
  }
  return result;
}

std::vector<Rectangle> solid_rectangles(const World& world) {
  std::vector<Rectangle> solids;
  for (const Box& box : world.boxes) solids.push_back(rectangle(box));
  for (const Wall& wall : world.walls) {
    for (const Segment& leg : legs(wall.points, wall.closed))
      solids.push_back(rectangle(leg, wall.thickness));
  }
  return solids;
}

double distance(const Eigen::Vector2d& point, const Segment& segment) {
  const Eigen::Vector2d along = segment.to - segment.from;
  const double squared_length = along.squaredNorm();
  const double fraction =
      squared_length > 0 ? std::clamp(along.dot(point - segment.from) / squared_length, 0.0, 1.0) : 0.0;
  return (point - segment.from - fraction * along).norm();
}

double distance(const Eigen::Vector2d& point, const Rectangle& rectangle) {
  const Eigen::Vector2d p_own = to_own_frame(point, rectangle);
  return (p_own.cwiseAbs() - rectangle.half).cwiseMax(0.0).norm();
}

double distance(const Eigen::Vector2d& point, const std::vector<Eigen::Vector2d>& polyline, bool closed) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& corner : polyline) nearest = std::min(nearest, (point - corner).norm());
  for (const Segment& leg : legs(polyline, closed)) nearest = std::min(nearest, distance(point, leg));
  return nearest;
}

double distance(const Segment& a, const Segment& b) {
  if (cross_properly(a, b)) return 0.0;
  return std::min({distance(a.from, b), distance(a.to, b), distance(b.from, a), distance(b.to, a)});
}

double distance(const Segment& segment, const Rectangle& rectangle) {
  const Segment own{to_own_frame(segment.from, rectangle), to_own_frame(segment.to, rectangle)};
  const Eigen::Vector2d& half = rectangle.half;
  const auto is_inside = [&](const Eigen::Vector2d& p) { return (p.cwiseAbs() - half).maxCoeff() <= 0; };
  if (is_inside(own.from) || is_inside(own.to)) return 0.0;
  const std::vector<Eigen::Vector2d> corners = {half, {-half.x(), half.y()}, -half, {half.x(), -half.y()}};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    nearest = std::min(nearest, distance(own, Segment{corners[i], corners[(i + 1) % corners.size()]}));
  }
  return nearest;
}

bool on_ground(const Eigen::Vector2d& centre, double radius, const Eigen::Vector2d& ground_size) {
  return (centre.cwiseAbs().array() + radius <= 0.5 * ground_size.array()).all();
}

double length(const std::vector<Eigen::Vector2d>& points, bool closed) {
  double sum = 0.0;
  for (const Segment& leg : legs(points, closed)) sum += (leg.to - leg.from).norm();
  return sum;
}

double largest_radius(const std::vector<Landmark>& landmarks) {
  double largest = 0.0;
  for (const Landmark& landmark : landmarks) largest = std::max(largest, landmark.radius);
  return largest;
}

double wheel_width(const Robot& robot) { return 0.5 * robot.wheel_radius; }

Footprint footprint(const Robot& robot) {
  const double half_width = 0.5 * (robot.track + wheel_width(robot));
  const Caster& caster = robot.caster;
  return {{std::min(-robot.wheel_radius, caster.offset - caster.radius), -half_width},
          {std::max(robot.wheel_radius, caster.offset + caster.radius), half_width}};
}

double footprint_radius(const Robot& robot) {
  const Footprint chassis = footprint(robot);
  return std::hypot(std::max(-chassis.min.x(), chassis.max.x()), chassis.max.y());
}

}  // namespace worlds
