// The motion update of the information form in constant time: Lemma 3 of the report.
#pragma once

#include "seif/information_state.hpp"
#include "seif/types.hpp"

namespace seif {

/// Moves the robot by an odometry increment. Its noise weakens the links of the robot, and makes links between
/// the active landmarks instead. Works in the window alone.
///
/// The update is exact (up to linearisation) for any residual and for motion noise of any rank, zero included.
/// The report's (36) differs in two points. It inverts S_x' A S_x, which is singular, although Psi = (I + A)^-1
/// has a closed form (Probabilistic Robotics, (12.12)). And in its information vector b_bar (xi here), the
/// change of the information matrix has the wrong sign. With the right sign, (36) leaves r unchanged, which is
/// exact while r_x = 0.
void motion_update(InformationState& state, const Odometry& odometry);

}  // namespace seif
