// Splits off what robot and other active landmarks know about a landmark that leaves the window.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "seif/information_state.hpp"

namespace seif {

/// What is frozen with a landmark z. Let W be the information of the window, without what was frozen before. Then
///   W = V V' + (0 and the marginal of the others),   V = W_:z F,   F F' = W_zz^-1:
/// V V' is the belief over z given the others. It is positive semidefinite, and it holds no information about
/// moving or turning everything, wherever W holds none. So it says only how z lies among the others.
struct FrozenPiece {
  struct Member {
    int slot;
    Eigen::Matrix2d V;          // its rows of V (2 x 2)
    Eigen::Vector2d reference;  // p_world_landmark when it was frozen [m]
  };
  int slot = -1;                                // z
  std::vector<Member> members;                  // z, and the active landmarks that W links it to
  Eigen::Vector2d y = Eigen::Vector2d::Zero();  // V y: the residual at the reference
};

/// Freezes the active landmarks `slots`, which sparsify() has unlinked from the robot, one after the other, and
/// deactivates them. `pieces` is resized to their number. False if the block of one is not positive definite.
[[nodiscard]] bool freeze(InformationState& state, std::span<const int> slots,
                          std::vector<FrozenPiece>& pieces);

}  // namespace seif
