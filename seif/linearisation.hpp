// Where the steps linearise: at the mean, or at the first estimates if the state uses them.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "seif/information_state.hpp"
#include "seif/types.hpp"

namespace seif {

class MovedBoundary;
struct Turning;

/// T_world_robot and p_world_landmark [m].
Pose2 linearisation_pose(const InformationState& state);
Eigen::Vector2d linearisation_point(const InformationState& state, int slot);

/// The lever: the vector from the pose to a landmark that is taken to be at p_world_landmark. It is the lever
/// between the first estimates if that is alike (are_levers_alike), otherwise the lever between the means. [m]
Eigen::Vector2d lever(const InformationState& state, int slot, const Eigen::Vector2d& p_world_landmark);

/// The pose in another frame of first estimates: that of active landmarks to which the linearisation pose does
/// not fit, as at the seam of a closed loop. Nothing if it fits to all.
std::optional<Pose2> other_linearisation_pose(const InformationState& state);

/// Sets the mean of the pose to the prediction of a motion; the caller must update r. Returns by how much the
/// pose moved from which levers are computed. [m]
Eigen::Vector2d move_to_prediction(InformationState& state, const Pose2& prediction);

/// To be called when the scan has moved the pose from `before`: from now on levers are computed from where the
/// pose is now. Omega and r change with it, so that Omega still holds no information about a turn of everything.
/// Does nothing where landmarks of another frame are in view.
void follow_pose(InformationState& state, const Pose2& before);

/// The robot, of which nothing is known, is put at `at`. Levers are computed from there.
void put_robot(InformationState& state, const Pose2& at);

/// All first estimates of the window become the means, with Omega and r turned and moved as they are. `moved`: scratch.
void carry_first_estimates(InformationState& state, const Turning& turning, MovedBoundary& moved);

/// Replaces the first estimates of active landmarks that are not settled yet by their means. Omega and r change
/// with them, so that Omega still holds no information about a turn of everything, now about the new first
/// estimates.
void update_first_estimates(InformationState& state);

}  // namespace seif
