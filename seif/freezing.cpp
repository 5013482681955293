#include "seif/freezing.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "seif/packed_triangle.hpp"

namespace seif {
namespace {

constexpr double least_information = 1e-10;  // [-] of a landmark's, below which there is only rounding

int row_in_window(const InformationState& state, int slot) {
  return InformationState::row_of(state.position(slot));
}

double rounding_of(const InformationState& state, int slot) {
  return least_information * state.information(slot).trace();
}

/// V V' (w x w) in state.work(), and V y (w x 1).
auto V_by_y(InformationState& state, std::span<const int> slots) {
  const int columns = 2 * static_cast<int>(slots.size()) + 2;
  return state.work_columns(columns).rightCols<1>();
}

/// Splits off all landmarks at once. False, with the window unchanged, if W_ZZ is not clearly positive definite.
bool split_off_together(InformationState& state, std::span<const int> slots) {
  const auto z = 2 * static_cast<int>(slots.size());
  auto columns = state.work_columns(z + 2);
  auto V = columns.leftCols(z);               // (w x 2|Z|)
  auto y = columns.col(z).head(z);            // (2|Z| x 1)
  auto L = state.work().topLeftCorner(z, z);  // (2|Z| x 2|Z|)
  Eigen::Index col = 0;
  for (const int slot : slots) {
    V.middleCols<2>(col) = state.Omega().middleCols<2>(row_in_window(state, slot));
    y.segment<2>(col) = state.r().segment<2>(row_in_window(state, slot));
    col += 2;
  }
  col = 0;
  for (const int slot : slots) {
    L.middleRows<2>(col) = V.middleRows<2>(row_in_window(state, slot));
    col += 2;
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(L);
  if (llt.info() != Eigen::Success) return false;
  col = 0;
  for (const int slot : slots) {
    const double least_pivot = L.diagonal().segment<2>(col).minCoeff();
    if (!(least_pivot * least_pivot > rounding_of(state, slot))) return false;
    col += 2;
  }
  llt.matrixU().solveInPlace<Eigen::OnTheRight>(V);
  llt.matrixL().solveInPlace(y);
  V.topRows<3>().setZero();  // the robot's links are zero except for rounding
  V_by_y(state, slots).noalias() = V * y;
  state.work().noalias() = V * V.transpose();
  state.touch(state.window_blocks());
  return true;
}

/// F with F F' = W_zz^-1, and without what W_zz holds no information about: a landmark may be active although every
/// observation of it was ignored. Nothing if W_zz is not positive semidefinite.
std::optional<Eigen::Matrix2d> root_of_inverse(const Eigen::Matrix2d& W_zz, double rounding) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(W_zz);
  Eigen::Matrix2d F = eigen.eigenvectors();
  for (int k = 0; k < 2; ++k) {
    const double information = eigen.eigenvalues()(k);
    if (!(information >= -rounding)) return std::nullopt;
    F.col(k) *= information > rounding ? 1.0 / std::sqrt(information) : 0.0;
  }
  return F;
}

/// The same, one landmark after the other: the sum of their V V' and V y. W_ZZ may be singular.
bool split_off_each(InformationState& state, std::span<const int> slots) {
  auto sum = state.work();            // (w x w)
  auto sum_r = V_by_y(state, slots);  // (w x 1)
  auto V = state.work_columns();      // (w x 3), of which two are used
  sum.setZero();
  sum_r.setZero();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const int row = row_in_window(state, slots[i]);
    const Eigen::Matrix2d W_zz = state.Omega().block<2, 2>(row, row) - sum.block<2, 2>(row, row);
    const std::optional<Eigen::Matrix2d> F = root_of_inverse(W_zz, rounding_of(state, slots[i]));
    if (!F) return false;
    auto V_z = V.leftCols<2>();
    V_z.noalias() = (state.Omega().middleCols<2>(row) - sum.middleCols<2>(row)) * *F;
    V_z.topRows<3>().setZero();
    for (const int gone : slots.first(i)) V_z.middleRows<2>(row_in_window(state, gone)).setZero();
    const Eigen::Vector2d y = F->transpose() * (state.r().segment<2>(row) - sum_r.segment<2>(row));
    sum_r.noalias() += V_z * y;
    sum.noalias() += V_z * V_z.transpose();
    state.touch(state.window_blocks());
  }
  return true;
}

void list_members(InformationState& state, FrozenPiece& piece) {
  piece.members.clear();
  const auto add = [&](int slot) {
    const int row = row_in_window(state, slot);
    if (!state.work().block<2, 2>(row, row).isZero(0.0)) piece.members.push_back({slot, state.mean(slot)});
  };
  for (const int slot : piece.slots) add(slot);
  for (int p = 0; p < state.active_count(); ++p) {
    if (std::ranges::find(piece.slots, state.active(p)) == piece.slots.end()) add(state.active(p));
  }
}

/// What was split off, among the landmarks that have some of it.
void fill(InformationState& state, FrozenPiece& piece) {
  list_members(state, piece);
  const auto sum = state.work();
  const auto sum_r = V_by_y(state, piece.slots);
  piece.r.clear();
  piece.Omega.clear();
  for (std::size_t j = 0; j < piece.members.size(); ++j) {
    for (int k = 0; k < 2; ++k) {
      const int col = row_in_window(state, piece.members[j].slot) + k;
      piece.r.push_back(sum_r(col));
      for (int below = 0; below < 2 - k; ++below) piece.Omega.push_back(sum(col + below, col));
      for (std::size_t i = j + 1; i < piece.members.size(); ++i) {
        const int row = row_in_window(state, piece.members[i].slot);
        piece.Omega.insert(piece.Omega.end(), {sum(row, col), sum(row + 1, col)});
      }
    }
  }
}

}  // namespace

Eigen::Matrix2d FrozenPiece::block(std::size_t i, std::size_t j) const {
  if (i < j) return block(j, i).transpose();
  const auto row = static_cast<Eigen::Index>(2 * i);
  const auto col = static_cast<Eigen::Index>(2 * j);
  const double* const left = Omega.data() + packed_index(rows(), row, col);
  const double* const right = Omega.data() + packed_index(rows(), row, col + 1);
  Eigen::Matrix2d block;
  block << left[0], i == j ? left[1] : right[0], left[1], right[1];
  return block;
}

void FrozenPiece::copy(const FrozenPiece& other) {
  make_room(other.slots.size(), other.members.size());
  *this = other;
}

void FrozenPiece::make_room(std::size_t most_slots, std::size_t most_members) {
  if (slots.capacity() < most_slots) slots.reserve(2 * most_slots);
  if (members.capacity() >= most_members) return;
  members.reserve(2 * most_members);
  r.reserve(4 * most_members);
  Omega.reserve(static_cast<std::size_t>(packed_size(static_cast<Eigen::Index>(4 * most_members))));
}

bool freeze(InformationState& state, std::span<const int> slots, FrozenPiece& piece) {
  piece.make_room(slots.size(), static_cast<std::size_t>(state.active_count()));
  piece.slots.assign(slots.begin(), slots.end());
  if (!split_off_together(state, slots) && !split_off_each(state, slots)) return false;
  fill(state, piece);
  state.Omega() -= state.work();
  state.frozen() += state.work();
  state.r() -= V_by_y(state, slots);
  for (const int slot : slots) {  // exactly, not except for rounding
    const int row = row_in_window(state, slot);
    state.Omega().middleCols<2>(row).setZero();
    state.Omega().middleRows<2>(row).setZero();
    state.r().segment<2>(row).setZero();
  }
  for (const int slot : slots) state.deactivate(state.position(slot));
  return true;
}

}  // namespace seif
