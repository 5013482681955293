#include "seif/freezing.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

namespace seif {
namespace {

/// F with F F' = W_zz^-1, and without what W_zz holds no information about: a landmark may be active although every
/// observation of it was ignored. Nothing if W_zz is not positive semidefinite.
std::optional<Eigen::Matrix2d> root_of_inverse(const Eigen::Matrix2d& W_zz, const Eigen::Matrix2d& all) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(W_zz);
  const double rounding = 1e-10 * all.trace();
  Eigen::Matrix2d F = eigen.eigenvectors();
  for (int k = 0; k < 2; ++k) {
    const double information = eigen.eigenvalues()(k);
    if (!(information >= -rounding)) return std::nullopt;
    F.col(k) *= information > rounding ? 1.0 / std::sqrt(information) : 0.0;
  }
  return F;
}

bool split_off(InformationState& state, int slot, FrozenPiece& piece) {
  const int row = InformationState::row_of(state.position(slot));
  auto W = state.Omega();
  auto r = state.r();
  const std::optional<Eigen::Matrix2d> F = root_of_inverse(W.block<2, 2>(row, row), state.information(slot));
  if (!F) return false;
  auto V = state.work_columns().leftCols<2>();  // (w x 2)
  V.noalias() = W.middleCols<2>(row) * *F;
  V.topRows<3>().setZero();  // the robot's link is zero except for rounding
  piece.slot = slot;
  piece.y = F->transpose() * r.segment<2>(row);
  piece.members.clear();
  for (int p = 0; p < state.active_count(); ++p) {
    const Eigen::Matrix2d V_p = V.middleRows<2>(InformationState::row_of(p));
    if (!V_p.isZero(0.0)) piece.members.push_back({state.active(p), V_p, state.mean(state.active(p))});
  }
  W.noalias() -= V * V.transpose();
  state.frozen().noalias() += V * V.transpose();
  r.noalias() -= V * piece.y;
  W.middleCols<2>(row).setZero();  // exactly, not except for rounding
  W.middleRows<2>(row).setZero();
  r.segment<2>(row).setZero();
  state.touch(state.window_blocks());
  return true;
}

}  // namespace

bool freeze(InformationState& state, std::span<const int> slots, std::vector<FrozenPiece>& pieces) {
  pieces.resize(slots.size());
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (!split_off(state, slots[i], pieces[i])) return false;
    state.deactivate(state.position(slots[i]));
  }
  return true;
}

}  // namespace seif
