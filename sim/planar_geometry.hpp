// Headings, and distances in the plane between a straight path and solids.
#pragma once

#include <Eigen/Core>

namespace sim {

/// The unit vector that points along a heading [rad].
Eigen::Vector2d direction(double heading);

/// The heading of a vector that is not zero. [rad] in (-pi, pi]
double heading_of(const Eigen::Vector2d& vector);

/// A straight path; start and end may be the same point.
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
  double heading = 0.0;                                 // [rad] of its own x axis
  Eigen::Vector2d half_size = Eigen::Vector2d::Zero();  // [m] along its own axes
};

/// Shortest distance from the path to the solid; 0 if they touch or cross. [m]
double distance(const Segment& way, const Disk& disk);
double distance(const Segment& way, const Rectangle& rectangle);

}  // namespace sim
