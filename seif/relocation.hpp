// Marginalises the robot out of the belief, exactly, so that fresh observations can put it back. In this way
// the exactly sparse filter limits the number of the robot's links.
#pragma once

#include "seif/information_state.hpp"
#include "seif/relocating/surroundings.hpp"

namespace seif {

/// Afterwards there is no information about the robot (Omega_xx = 0; its mean stays as the linearisation point), and the
/// belief over the map is unchanged. The window keeps its landmarks. False, with the state unchanged, if Omega_xx is not
/// positive definite.
[[nodiscard]] bool forget_robot(InformationState& state);

/// Afterwards there is no information about the robot (Omega_xx = 0; its mean stays as the linearisation
/// point), every landmark is passive, and the belief over the map is unchanged. False, with the state
/// unchanged, if Omega_xx is not positive definite.
[[nodiscard]] bool marginalise_robot(InformationState& state);

/// Adds the surroundings as one observation of all their landmarks, which are in the map: Omega += J' C^-1 J,
/// r += J' C^-1 v. Takes them into the window. With first estimates nothing is learnt of a turn of everything.
void add_surroundings(InformationState& state, const Relocation& relocation);

}  // namespace seif
