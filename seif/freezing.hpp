// Splits off what robot and other active landmarks know about the landmarks that leave the window.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "seif/aligned_numbers.hpp"
#include "seif/information_state.hpp"

namespace seif {

/// What is frozen with the landmarks Z that leave the window together. Let W be the information of the window, without
/// what was frozen before. Then
///   W = V V' + (0 and the marginal of the others),   V = W_:Z L^-T,   L L' = W_ZZ:
/// V V' is the belief over Z given the others. It is positive semidefinite, and it holds no information about
/// moving or turning everything, wherever W holds none. So it says only how Z lies among the others.
struct FrozenPiece {
  struct Member {
    int slot;
    Eigen::Vector2d reference;  // p_world_landmark when it was frozen [m]
  };
  std::vector<int> slots;       // Z
  std::vector<Member> members;  // m of them: Z first, then the active landmarks that W links it to
  AlignedNumbers Omega;         // (2m x 2m) V V' among the members, packed (packed_triangle.hpp)
  AlignedNumbers r;             // (2m) V y with y = L^-1 r_Z: the residual at the reference

  Eigen::Index rows() const { return 2 * static_cast<Eigen::Index>(members.size()); }  // 2m
  /// Omega_ij of two members.
  Eigen::Matrix2d block(std::size_t i, std::size_t j) const;
  /// The same as `other`, with room for larger ones, so that no update allocates.
  void copy(const FrozenPiece& other);
  /// Room for twice as many.
  void make_room(std::size_t most_slots, std::size_t most_members);
};

/// Freezes the active landmarks `slots`, which sparsify() has unlinked from the robot, and deactivates them. False if
/// their block is not positive semidefinite.
[[nodiscard]] bool freeze(InformationState& state, std::span<const int> slots, FrozenPiece& piece);

}  // namespace seif
