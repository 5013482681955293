// The paths that drives follow.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "worlds/world.hpp"

namespace worlds {

/// Corners of a path that covers the rectangle from `min` to `max` in lanes along x, from the lowest to the
/// highest y, every other one backwards. The lanes are evenly spaced, at most `lane` apart, the outer ones on
/// the edges. All in [m]; lane > 0 and min <= max.
std::vector<Eigen::Vector2d> serpentine(const Eigen::Vector2d& min, const Eigen::Vector2d& max, double lane);

/// Where the world's robot is meant to drive: from its start to the path of its drive and along it, or where
/// its commands would take an ideal robot; for other drives the start alone.
std::vector<Eigen::Vector2d> driven_path(const World& world);

}  // namespace worlds
