#include "worlds/free_space.hpp"

#include <algorithm>

#include "worlds/path.hpp"

namespace worlds {

FreeSpace::FreeSpace(const World& world, double radius, const Clearances& clear, double own_distance)
    : ground_size_(world.ground_size),
      radius_(radius),
      own_distance_(std::max(own_distance, 2 * radius + clear.landmarks)),
      clear_landmarks_(clear.landmarks),
      foreign_count_(world.landmarks.size()),
      points_(std::max(own_distance_, radius + largest_radius(world.landmarks) + clear.landmarks)),
      keep_outs_(keep_outs(world, clear), clearances_) {
  for (const Landmark& landmark : world.landmarks) {
    points_.add(landmark.position);
    radii_.push_back(landmark.radius);
  }
}

std::vector<Rectangle> FreeSpace::keep_outs(const World& world, const Clearances& clear) {
  std::vector<Rectangle> shapes;
  const auto keep_out = [&](const Rectangle& shape, double clearance) {
    shapes.push_back(shape);
    clearances_.push_back(clearance + radius_);
  };
  for (const Rectangle& solid : solid_rectangles(world)) keep_out(solid, clear.walls);
  const auto keep_out_of_robot = [&](const Eigen::Vector2d& p) {
    keep_out(rectangle(Segment{p, p}, 0.0), footprint_radius(world.robot));
  };
  const auto keep_out_of_way = [&](const Placement& start, const Drive& drive) {
    for (const Segment& leg : legs(driven_path(start, drive, world.duration), false))
      keep_out(rectangle(leg, 0.0), clear.path);
    keep_out_of_robot(start.position);
  };
  if (world.robots.empty()) keep_out_of_way(world.robot.start, world.drive);
  for (const TeamRobot& robot : world.robots) keep_out_of_way(robot.start, robot.drive);
  for (const Fault& fault : world.faults) {
    if (fault.kind == FaultKind::kidnapping) keep_out_of_robot(fault.to.position);
  }
  return shapes;
}

bool FreeSpace::is_free(const Eigen::Vector2d& p) const {
  if (!on_ground(p, radius_, ground_size_)) return false;
  const bool is_blocked = keep_outs_.any_near(
      p, 0.0, [&](std::size_t i, const Rectangle& shape) { return distance(p, shape) < clearances_[i]; });
  if (is_blocked) return false;
  return !points_.any_near(p, [&](std::size_t i, const Eigen::Vector2d& other) {
    const double least = i < foreign_count_ ? radius_ + radii_[i] + clear_landmarks_ : own_distance_;
    return (p - other).squaredNorm() < least * least;
  });
}

void FreeSpace::add(const Eigen::Vector2d& p) {
  points_.add(p);
  radii_.push_back(radius_);
}

}  // namespace worlds
