// Headings, and distances on the plane between a straight way and what stands on it.
#pragma once

#include <Eigen/Core>

namespace sim {

/// The unit vector that points along a heading [rad].
Eigen::Vector2d direction(double heading);

/// The heading of a vector that is not zero. [rad] in (-pi, pi]
double heading_of(const Eigen::Vector2d& vector);

/// A straight way; start and end may be one point.
struct Segment {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  // p_world [m]
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    // p_world [m]
};

struct Disk {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // p_world [m]
  double radius = 0.0;                               // [m]
};

struct Rectangle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();     // p_world [m]
  double heading = 0.0;                                 // [rad] of its own x
  Eigen::Vector2d half_size = Eigen::Vector2d::Zero();  // [m] along its own x and y
};

/// Shortest distance from the way to the solid, 0 if they touch or cross. [m]
double distance(const Segment& way, const Disk& disk);
double distance(const Segment& way, const Rectangle& rectangle);

}  // namespace sim
