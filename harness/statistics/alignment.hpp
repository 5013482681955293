// The rigid motion in the plane that brings one set of points closest to another.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "seif/types.hpp"

namespace harness {

/// T_to_from that minimises sum |p_to - T_to_from * p_from|^2 over corresponding points, in closed form:
/// Umeyama (PAMI 1991) in the plane without scale. Empty if the points fix no rotation: there are fewer than
/// two, or all are equal. The spans have equal length.
std::optional<seif::Pose2> align(std::span<const Eigen::Vector2d> p_from,
                                 std::span<const Eigen::Vector2d> p_to);

}  // namespace harness
