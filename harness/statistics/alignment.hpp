// The rigid motion of the plane that brings one set of points closest to another.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "seif/types.hpp"

namespace harness {

/// T_to_from that minimises sum |p_to - T_to_from * p_from|^2 over corresponding points: Umeyama (PAMI 1991)
/// for the plane without scale, in closed form. Nothing if the points do not determine a rotation: fewer than
/// two, or all the same. The spans are of equal length.
std::optional<seif::Pose2> align(std::span<const Eigen::Vector2d> p_from,
                                 std::span<const Eigen::Vector2d> p_to);

}  // namespace harness
