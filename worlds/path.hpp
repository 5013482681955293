// The paths that the robot follows.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "worlds/world.hpp"

namespace worlds {

/// Corners of a path that covers the rectangle from `min` to `max` in lanes along x, from the lowest to the
/// highest y. Every second lane is driven backwards, in -x. The lanes are evenly spaced, at most `lane` apart,
/// with the outer ones on the edges. All in [m]; lane > 0 and min <= max.
std::vector<Eigen::Vector2d> serpentine(const Eigen::Vector2d& min, const Eigen::Vector2d& max, double lane);

/// The path that the robot is meant to drive: from its start to the path of its drive and along it, or the path
/// of an ideal robot under its commands. For other drives only the start.
std::vector<Eigen::Vector2d> driven_path(const Placement& start, const Drive& drive, double duration);
/// That of the world's only robot.
std::vector<Eigen::Vector2d> driven_path(const World& world);

}  // namespace worlds
