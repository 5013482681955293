// The friction of the ground where a wheel stands.
#pragma once

#include <Eigen/Core>

#include "worlds/world.hpp"

namespace sim {

/// The Coulomb coefficient [-] at a place: that of the last patch that contains it, otherwise that of the
/// ground.
double ground_friction(const worlds::Physics& physics, const Eigen::Vector2d& p_world);

}  // namespace sim
