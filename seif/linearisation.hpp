// Where the steps linearise: at the mean, or at the first estimates if the state uses them.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "seif/information_state.hpp"
#include "seif/types.hpp"

namespace seif {

/// T_world_robot and p_world_landmark [m].
Pose2 linearisation_pose(const InformationState& state);
Eigen::Vector2d linearisation_point(const InformationState& state, int slot);

/// From the pose to a landmark that is taken to be at p_world_landmark: the lever between the first estimates
/// if it is like the one between the means. [m]
Eigen::Vector2d lever(const InformationState& state, int slot, const Eigen::Vector2d& p_world_landmark);

/// The pose as the first estimates of other active landmarks have it, to which the linearisation pose does not
/// fit, as at the seam of a closed loop. Nothing if it fits to all.
std::optional<Pose2> other_linearisation_pose(const InformationState& state);

/// Sets the mean of the pose to a motion's prediction; the caller keeps r. Returns by how much the pose moved
/// from which levers are taken. [m]
Eigen::Vector2d move_to_prediction(InformationState& state, const Pose2& prediction);

/// Replaces the first estimates of active landmarks that are not settled yet by their means. The information
/// follows: Omega then knows nothing of turning everything about the new ones.
void update_first_estimates(InformationState& state);

}  // namespace seif
