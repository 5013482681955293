// The motion update of the information form in constant time: Lemma 3 of the report.
#pragma once

#include "seif/information_state.hpp"
#include "seif/types.hpp"

namespace seif {

/// Moves the robot by an odometry increment and lets its noise weaken the links of the robot, which become
/// links between the active landmarks. Touches the window alone.
///
/// It is exact (up to linearisation) for any residual and any rank of the motion noise, none included. The
/// report's (36) differs twice: it inverts the singular S_x' A S_x where Psi = (I + A)^-1 is at hand (the
/// book's (12.12)), and its b_bar has the sign of H' - H wrong. With the sign right, (36) leaves r as it is,
/// which is exact while r_x = 0.
void motion_update(InformationState& state, const Odometry& odometry);

}  // namespace seif
