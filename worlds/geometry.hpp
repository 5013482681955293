// Distances on the plane, between what stands in a world.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "worlds/world.hpp"

namespace worlds {

/// A rectangle that may be turned. Walls are rectangles along their segments; a segment is one of no width.
struct Rectangle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // p_world [m]
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();   // of its own x, unit length [-]
  Eigen::Vector2d half = Eigen::Vector2d::Zero();    // half its size along its own x and y [m]
};

struct Segment {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    // [m]
};

Rectangle rectangle(const Box& box);
Rectangle rectangle(const Segment& segment, double thickness);

/// The legs of a polyline; a closed one has a last leg back to its first point. Legs of no length are left
/// out.
std::vector<Segment> legs(const std::vector<Eigen::Vector2d>& points, bool closed);

/// What blocks motion and sight: all boxes, then the legs of all walls.
std::vector<Rectangle> solid_rectangles(const World& world);

/// Distances are between the nearest points, 0 where things overlap. [m]
double distance(const Eigen::Vector2d& point, const Segment& segment);
double distance(const Eigen::Vector2d& point, const Rectangle& rectangle);
double distance(const Eigen::Vector2d& point, const std::vector<Eigen::Vector2d>& polyline, bool closed);
double distance(const Segment& a, const Segment& b);
double distance(const Segment& segment, const Rectangle& rectangle);

/// Whether a disk lies wholly on the ground.
bool on_ground(const Eigen::Vector2d& centre, double radius, const Eigen::Vector2d& ground_size);

/// The length of a polyline. [m]
double length(const std::vector<Eigen::Vector2d>& points, bool closed);

/// The radius of the largest landmark, 0 if there are none. [m]
double largest_radius(const std::vector<Landmark>& landmarks);

/// How wide a wheel is: half its radius. [m]
double wheel_width(const Robot& robot);

/// What the chassis covers of the ground, in the robot frame: as wide as the wheels, as long as wheels and
/// caster.
struct Footprint {
  Eigen::Vector2d min;  // [m]
  Eigen::Vector2d max;  // [m]
};
Footprint footprint(const Robot& robot);

/// The radius about the middle of the axle within which the robot stays, whatever its heading. [m]
double footprint_radius(const Robot& robot);

}  // namespace worlds
