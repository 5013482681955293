// The rigid motion in the plane that brings one set of points closest to another.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "seif/types.hpp"

namespace harness {

/// T_to_from that minimises sum |p_to - T_to_from * p_from|^2 over corresponding points: the closed form of
/// Umeyama (PAMI 1991) for the plane, without scale. Empty if the points do not fix a rotation: fewer than
/// two points, or all points equal. The spans have equal lengths.
std::optional<seif::Pose2> align(std::span<const Eigen::Vector2d> p_from,
                                 std::span<const Eigen::Vector2d> p_to);

}  // namespace harness
