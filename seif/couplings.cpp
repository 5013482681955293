#include "seif/couplings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "seif/start_points.hpp"

namespace seif {
namespace {

using std::max, std::min;

/// Appends M_ab as a coupling to `other`, unless it is zero. `M_aa` and `M_bb` are the diagonal in its rows and
/// in its columns. In a matrix that is not positive definite the ratio may exceed 1, or be the root of a
/// negative number; then it counts as 1.
template <class Block, class RowDiagonal, class ColumnDiagonal>
void append(LandmarkId other, const Block& M_ab, const RowDiagonal& M_aa, const ColumnDiagonal& M_bb,
            std::vector<Coupling>& out) {
  if (is_start_point(other)) return;
  double strength = 0.0;
  for (Eigen::Index i = 0; i < M_ab.rows(); ++i) {
    for (Eigen::Index j = 0; j < M_ab.cols(); ++j) {
      if (M_ab(i, j) == 0.0) continue;
      const double ratio = std::abs(M_ab(i, j)) / std::sqrt(M_aa(i) * M_bb(j));
      strength = max(strength, ratio < 1.0 ? ratio : 1.0);
    }
  }
  if (strength > 0.0) out.push_back({.other = other, .strength = strength});
}

/// Of all of the window's information, frozen or not.
Eigen::Matrix2d block_of(const InformationState& state, int row, int col) {
  return state.Omega().block<2, 2>(row, col) + state.frozen().block<2, 2>(row, col);
}

void append_links_of_robot(const InformationState& state, std::vector<Coupling>& out) {
  const auto Omega = state.Omega();
  for (int position = 0; position < state.active_count(); ++position) {
    const int row = InformationState::row_of(position);
    const Eigen::Vector2d diagonal = block_of(state, row, row).diagonal();
    append(state.id(state.active(position)), Omega.block<2, 3>(row, 0), diagonal, Omega.diagonal().head<3>(),
           out);
  }
}

/// The couplings between the landmark at a position of the window and everything in the window.
void append_links_in_window(const InformationState& state, int position, std::vector<Coupling>& out) {
  const auto Omega = state.Omega();
  const int row = InformationState::row_of(position);
  const Eigen::Vector2d diagonal = block_of(state, row, row).diagonal();
  append(no_landmark, Omega.block<2, 3>(row, 0), diagonal, Omega.diagonal().head<3>(), out);
  for (int other = 0; other < state.active_count(); ++other) {
    if (other == position) continue;
    // The block below the diagonal, since rounding may make the two triangles differ.
    const int low = InformationState::row_of(max(position, other));
    const int high = InformationState::row_of(min(position, other));
    append(state.id(state.active(other)), block_of(state, low, high),
           Eigen::Vector2d(block_of(state, low, low).diagonal()),
           Eigen::Vector2d(block_of(state, high, high).diagonal()), out);
  }
}

}  // namespace

void couplings_of(const InformationState& state, LandmarkId of, std::vector<Coupling>& out) {
  out.clear();
  if (of == no_landmark) return append_links_of_robot(state, out);
  const std::optional<int> slot = state.find(of);
  if (!slot) return;
  if (const int position = state.position(*slot); position >= 0) append_links_in_window(state, position, out);
  const Eigen::Vector2d Omega_ss = state.information(*slot).diagonal();
  state.for_each_neighbour(*slot, [&](int other, const auto& Omega_so) {
    const Eigen::Vector2d Omega_oo = state.information(other).diagonal();
    append(state.id(other), Omega_so, Omega_ss, Omega_oo, out);
  });
}

void couplings_of(const Eigen::Ref<const Eigen::MatrixXd>& M, const LandmarkIndex& index,
                  std::span<const LandmarkId> ids, LandmarkId of, std::vector<Coupling>& out) {
  constexpr int robot = -1;
  out.clear();
  const std::optional<int> slot = of == no_landmark ? robot : index.find(of);
  if (!slot) return;
  const auto diagonal = M.diagonal();
  const auto append_link_to_robot = [&](LandmarkId other, int of_slot) {
    const int row = InformationState::row_of(of_slot);
    append(other, M.block<2, 3>(row, 0), diagonal.segment<2>(row), diagonal.head<3>(), out);
  };
  if (*slot != robot) append_link_to_robot(no_landmark, *slot);
  for (int other = 0; other < static_cast<int>(ids.size()); ++other) {
    const LandmarkId id = ids[static_cast<std::size_t>(other)];
    if (*slot == robot) {
      append_link_to_robot(id, other);
    } else if (other != *slot) {
      const int low = InformationState::row_of(max(*slot, other));
      const int high = InformationState::row_of(min(*slot, other));
      append(id, M.block<2, 2>(low, high), diagonal.segment<2>(low), diagonal.segment<2>(high), out);
    }
  }
}

}  // namespace seif
