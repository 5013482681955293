#include "seif/tree/window_solution.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace seif {

/// The information on the active landmarks of all that is frozen (w x w).
void WindowSolution::add_zone(const InformationState& state, Eigen::Ref<Eigen::MatrixXd> Omega) const {
  for (int p = 0; p < state.active_count(); ++p) {
    const int h = index(state.active(p));
    for (int q = 0; q < state.active_count(); ++q) {
      Omega.block<2, 2>(InformationState::row_of(p), InformationState::row_of(q)) +=
          zone_.block(h, index(state.active(q)));
    }
  }
}

void WindowSolution::add_residual(const InformationState& state, Eigen::Ref<Eigen::VectorXd> r) const {
  for (int p = 0; p < state.active_count(); ++p) {
    r.segment<2>(InformationState::row_of(p)) +=
        zone_.residual(index(state.active(p)), [&](int slot) { return state.mean(slot); });
  }
}

void WindowSolution::reserve(Eigen::Index rows) {
  if (M_.rows() >= rows) return;
  M_.resize(2 * rows, 2 * rows);
  step_.resize(2 * rows);
  change_.resize(2 * rows);
  factor_.storage.resize(2 * rows, 2 * rows);
}

bool WindowSolution::solve(InformationState& state) {
  const int w = state.window_size();
  reserve(w);
  auto M = M_.topLeftCorner(w, w);
  M = state.Omega();
  add_zone(state, M);
  factor_.size = w;
  auto L = factor_.L();
  L = M;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(L);
  if (llt.info() != Eigen::Success) return false;
  auto r = change_.head(w);
  r = state.r();
  add_residual(state, r);
  auto d = step_.head(w);
  d = r;
  llt.solveInPlace(d);
  factor_.chi_square_drop = r.dot(d);
  r.noalias() = state.Omega() * d;
  state.move_window(d, r);
  state.touch(2 * state.window_blocks());
  return true;
}

/// With L of Omega + S = L L' and columns Y that take a step of the window to one of pose or landmark, of
/// those that are not active by -W': the covariance is (L^-1 Y)' (L^-1 Y), and F_PP^-1 beside it.
void WindowSolution::covariance(const InformationState& state, std::span<const int> slots,
                                Eigen::Ref<Eigen::MatrixXd> out) const {
  const int w = state.window_size();
  const auto n = static_cast<Eigen::Index>(3 + 2 * slots.size());
  if (by_factor_.rows() < w || by_factor_.cols() < n) {
    // Mostly enough, so that it does not come to grow when the map is long known.
    constexpr Eigen::Index room = 128;
    by_factor_.resize(std::max({room, Eigen::Index{2} * w, by_factor_.rows()}),
                      std::max({room, 2 * n, by_factor_.cols()}));
  }
  auto Y = by_factor_.topLeftCorner(w, n);
  set_columns(state, slots, Y);
  factor_.L().triangularView<Eigen::Lower>().solveInPlace(Y);
  out.noalias() = Y.transpose() * Y;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = 0; j < slots.size(); ++j) {
      if (state.position(slots[i]) >= 0 || state.position(slots[j]) >= 0) continue;
      out.block<2, 2>(static_cast<Eigen::Index>(3 + 2 * i), static_cast<Eigen::Index>(3 + 2 * j)) -=
          zone_.block(index(slots[i]), index(slots[j]));
    }
  }
}

void WindowSolution::set_columns(const InformationState& state, std::span<const int> slots,
                                 Eigen::Ref<Eigen::MatrixXd> Y) const {
  Y.setZero();
  Y.topLeftCorner<3, 3>().setIdentity();
  Eigen::Index col = 3;
  for (const int slot : slots) {
    if (const int p = state.position(slot); p >= 0) {
      Y.block<2, 2>(InformationState::row_of(p), col).setIdentity();
    } else {
      for (int p_active = 0; p_active < state.active_count(); ++p_active)
        Y.block<2, 2>(InformationState::row_of(p_active), col) =
            -zone_.block(index(state.active(p_active)), index(slot));
    }
    col += 2;
  }
}

}  // namespace seif
