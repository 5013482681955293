// Shapes in the plane, and distances between them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "worlds/world.hpp"

namespace worlds {

/// A rectangle that may be turned. A leg of a wall is a rectangle along its segment; a segment is a rectangle
/// without width.
struct Rectangle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // p_world [m]
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();   // direction of its own x axis, unit length [-]
  Eigen::Vector2d half = Eigen::Vector2d::Zero();    // half its size along its own axes [m]
};

struct Segment {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    // [m]
};

Rectangle rectangle(const Box& box);
Rectangle rectangle(const Segment& segment, double thickness);

/// The segments (legs) of a polyline. A closed one has a last leg back to its first point. Legs of zero length
/// are left out.
std::vector<Segment> legs(const std::vector<Eigen::Vector2d>& points, bool closed);

/// Everything that blocks motion and sight: all boxes, then the legs of all walls.
std::vector<Rectangle> solid_rectangles(const World& world);

/// Distances between the nearest points; 0 where the shapes overlap. [m]
double distance(const Eigen::Vector2d& point, const Segment& segment);
double distance(const Eigen::Vector2d& point, const Rectangle& rectangle);
double distance(const Eigen::Vector2d& point, const std::vector<Eigen::Vector2d>& polyline, bool closed);
double distance(const Segment& a, const Segment& b);
double distance(const Segment& segment, const Rectangle& rectangle);

/// Whether a disk lies wholly on the ground.
bool on_ground(const Eigen::Vector2d& centre, double radius, const Eigen::Vector2d& ground_size);

/// The length of a polyline. [m]
double length(const std::vector<Eigen::Vector2d>& points, bool closed);

/// The radius of the largest landmark; 0 if there is no landmark. [m]
double largest_radius(const std::vector<Landmark>& landmarks);

/// The width of a wheel: half its radius. [m]
double wheel_width(const Robot& robot);

/// The ground that the chassis covers, in the robot frame: as wide as the wheels, as long as wheels and caster.
struct Footprint {
  Eigen::Vector2d min;  // [m]
  Eigen::Vector2d max;  // [m]
};
Footprint footprint(const Robot& robot);

/// The radius around the middle of the axle within which the robot stays at any heading. [m]
double footprint_radius(const Robot& robot);

}  // namespace worlds
