// Two points that stand for the start, so that nothing but their places ties the map to the world.
#pragma once

#include <Eigen/Core>
#include <array>

#include "seif/counts.hpp"
#include "seif/information_state.hpp"
#include "seif/types.hpp"

namespace seif {

/// Names for landmarks of an information state that are none.
inline constexpr std::array<LandmarkId, 2> start_points{-2, -3};
constexpr bool is_start_point(LandmarkId id) { return id < no_landmark; }

/// [m] How well the places of the start points are known: better than anything else.
inline constexpr double start_point_sd = 1e-7;

/// Adds and activates two landmarks: the place of the start, and a point one metre ahead of it. Turns the prior of
/// the pose, with this covariance (3 x 3), into one of the pose relative to these points. So Omega holds no
/// information about moving and turning everything. To be called before anything else changes the state.
void relate_to_start(InformationState& state, const Eigen::Matrix3d& covariance);

/// [-] Start points that are linked to the robot.
int active_start_points(const InformationState& state);

/// The links and the active landmarks among `counts` without those of start points.
Counts without_start_points(const InformationState& state, Counts counts);

}  // namespace seif
