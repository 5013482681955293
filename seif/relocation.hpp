// Marginalises the robot out of the belief, exactly, so that it can be put back from fresh observations: how
// the exactly sparse filter keeps the robot's links few.
#pragma once

#include "seif/information_state.hpp"

namespace seif {

/// Afterwards nothing is known of where the robot is (Omega_xx = 0; its mean stays as the point to linearise
/// at), every landmark is passive, and the belief over the map is what it was. False, with the state
/// unchanged, if Omega_xx is not positive definite.
[[nodiscard]] bool marginalise_robot(InformationState& state);

}  // namespace seif
