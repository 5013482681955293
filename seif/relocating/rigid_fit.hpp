// The rigid motion that takes points closest to others.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "seif/types.hpp"

namespace seif {

/// T_b_a with the least sum of |T_b_a p_a - p_b|^2 over the pairs of points at the same place of both lists [m]. Nothing
/// for fewer than two.
std::optional<Pose2> rigid_fit(std::span<const Eigen::Vector2d> p_a, std::span<const Eigen::Vector2d> p_b);

}  // namespace seif
