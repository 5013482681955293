// Marginalises the robot out of the belief, exactly, so that fresh observations can put it back. In this way
// the exactly sparse filter limits the number of the robot's links.
#pragma once

#include "seif/information_state.hpp"

namespace seif {

/// Afterwards there is no information about the robot (Omega_xx = 0; its mean stays as the linearisation
/// point), every landmark is passive, and the belief over the map is unchanged. False, with the state
/// unchanged, if Omega_xx is not positive definite.
[[nodiscard]] bool marginalise_robot(InformationState& state);

}  // namespace seif
