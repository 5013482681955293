// The solid things on the ground: landmarks, boxes and walls. World frame: x east, y north.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "worlds/placement.hpp"

namespace worlds {

/// A vertical cylinder that the sensor can see and the robot can bump into.
struct Landmark {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // p_world of the axis [m]
  double radius = 0.1;                                 // [m]
};

/// A box on the ground that blocks motion and sight.
struct Box {
  Placement centre;
  Eigen::Vector2d size = Eigen::Vector2d::Ones();  // [m] along its own x and y
  double height = 1.0;                             // [m]
};

/// A wall along a polyline that blocks motion and sight.
struct Wall {
  std::vector<Eigen::Vector2d> points;  // [m], at least two
  double thickness = 0.15;              // [m]
  double height = 1.0;                  // [m]
  bool closed = false;                  // the wall goes back from the last point to the first
};

}  // namespace worlds
