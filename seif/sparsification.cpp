#include "seif/sparsification.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "seif/full_state.hpp"
#include "seif/linearisation.hpp"

namespace seif {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Columns = Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, 3>>;
using LLT3 = Eigen::LLT<Eigen::Matrix3d>;

/// Marginalises the landmarks Z, `slots`, out of D in state.work(): D -= D_:Z D_ZZ^-1 D_Z:. False if D_ZZ is not
/// positive definite.
bool marginalise_landmarks(InformationState& state, std::span<const int> slots) {
  const auto z = 2 * static_cast<int>(slots.size());
  auto D = state.work();
  auto columns = state.work_columns(2 * z);
  auto V = columns.leftCols(z);              // (w x 2|Z|)
  auto L = columns.rightCols(z).topRows(z);  // (2|Z| x 2|Z|)
  for (std::size_t i = 0; i < slots.size(); ++i)
    V.middleCols<2>(static_cast<Eigen::Index>(2 * i)) =
        D.middleCols<2>(InformationState::row_of(state.position(slots[i])));
  for (std::size_t i = 0; i < slots.size(); ++i)
    L.middleRows<2>(static_cast<Eigen::Index>(2 * i)) =
        V.middleRows<2>(InformationState::row_of(state.position(slots[i])));
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(L);
  if (llt.info() != Eigen::Success) return false;
  llt.matrixU().solveInPlace<Eigen::OnTheRight>(V);
  D.noalias() -= V * V.transpose();
  state.touch(state.window_blocks());
  return true;
}

/// The logarithm of det M. Nothing if M (3 x 3) is not positive definite.
std::optional<double> log_determinant(const Eigen::Matrix3d& M) {
  const LLT3 llt(M);
  if (llt.info() != Eigen::Success) return std::nullopt;
  return 2.0 * llt.matrixLLT().diagonal().array().log().sum();
}

/// Removes the robot's links to the landmarks `slots`. D in state.work() is the belief over the window from
/// which p(x | Y+) is taken; x, K, Z are the robot, the landmarks that stay and those that go. Eq. (50) is then
///   [Lambda X] = rows x of the marginal of D over (x, K),
///   Omega_mm -= Omega_mx Omega_xx^-1 Omega_xm  (the robot marginalised out; m: all landmarks of the window),
///   Omega_xx = Lambda, Omega_xK = X, Omega_xZ = 0, Omega_KK += X' Lambda^-1 X.
bool drop_links(InformationState& state, std::span<const int> slots) {
  auto Omega = state.Omega();
  auto D = state.work();          // (w x w)
  auto V = state.work_columns();  // (w x 3)
  if (!marginalise_landmarks(state, slots)) return false;
  for (const int slot : slots) {  // these links are zero except for rounding
    D.topRows<3>().middleCols<2>(InformationState::row_of(state.position(slot))).setZero();
  }
  const LLT3 Omega_xx(Eigen::Matrix3d(Omega.topLeftCorner<3, 3>()));
  const LLT3 Lambda(Eigen::Matrix3d(D.topLeftCorner<3, 3>()));
  if (Omega_xx.info() != Eigen::Success || Lambda.info() != Eigen::Success) return false;

  const auto rows = Omega.rows() - 3;
  auto Omega_mm = Omega.bottomRightCorner(rows, rows);
  auto V_m = V.bottomRows(rows);
  V_m = Omega.bottomLeftCorner(rows, 3);
  Omega_xx.matrixU().solveInPlace<Eigen::OnTheRight>(V_m);
  Omega_mm.noalias() -= V_m * V_m.transpose();

  Omega.topRows<3>() = D.topRows<3>();
  Omega.bottomLeftCorner(rows, 3) = D.topRightCorner(3, rows).transpose();
  V_m = Omega.bottomLeftCorner(rows, 3);
  Lambda.matrixU().solveInPlace<Eigen::OnTheRight>(V_m);
  Omega_mm.noalias() += V_m * V_m.transpose();
  state.touch(2 * state.window_blocks());
  return true;
}

/// The information matrix of the marginal over the window, the passive landmarks P marginalised out:
/// Omega_ww - Omega_wP Omega_PP^-1 Omega_Pw (w x w). Nothing if Omega_PP is not positive definite.
std::optional<Eigen::MatrixXd> window_marginal(const InformationState& state) {
  const Sparse Omega = full_Omega(state).selfadjointView<Eigen::Lower>();
  const int window = state.window_size();
  Eigen::VectorXi order(
      Omega.rows());  // old row -> new row: the window in its own order, then the passive landmarks
  order.head<3>() << 0, 1, 2;
  int next = window;
  for (int slot = 0; slot < state.landmark_count(); ++slot) {
    const int position = state.position(slot);
    const int to = position < 0 ? std::exchange(next, next + 2) : InformationState::row_of(position);
    order.segment<2>(InformationState::row_of(slot)) << to, to + 1;
  }
  const Eigen::PermutationMatrix<Eigen::Dynamic> permutation(order);
  const Sparse ordered = permutation * Omega * permutation.transpose();
  const auto passive = static_cast<int>(Omega.rows()) - window;
  if (passive == 0) return Eigen::MatrixXd(state.Omega());
  const Sparse Omega_PP = ordered.bottomRightCorner(passive, passive);
  const Eigen::MatrixXd Omega_Pw = ordered.bottomLeftCorner(passive, window);
  const Eigen::SimplicialLLT<Sparse> llt(Omega_PP);
  if (llt.info() != Eigen::Success) return std::nullopt;
  return state.Omega() - Omega_Pw.transpose() * llt.solve(Omega_Pw);
}

/// V = D P (w x 3). The columns of P are the rigid-body modes of the window, scaled to unit length: the two
/// translations, and the rotation about the robot. `scales` gets the lengths before scaling.
void apply_to_rigid_modes(const InformationState& state, const Eigen::Ref<const Eigen::MatrixXd>& D,
                          Columns V, Eigen::Vector3d& scales) {
  V = D.leftCols<3>();
  double squared_levers = 0.0;
  for (int position = 0; position < state.active_count(); ++position) {
    const int row = InformationState::row_of(position);
    const int slot = state.active(position);
    const Eigen::Vector2d lever = seif::lever(state, slot, state.mean(slot));
    V.leftCols<2>() += D.middleCols<2>(row);
    V.col(2) += lever.x() * D.col(row + 1) - lever.y() * D.col(row);
    squared_levers += lever.squaredNorm();
  }
  const double translation = std::sqrt(1.0 + state.active_count());
  scales << translation, translation, std::sqrt(1.0 + squared_levers);
  V = V * scales.cwiseInverse().asDiagonal();
}

/// P' V (3 x 3), with P of apply_to_rigid_modes().
Eigen::Matrix3d project_on_rigid_modes(const InformationState& state, const Columns& V,
                                       const Eigen::Vector3d& scales) {
  Eigen::Matrix3d PtV = V.topRows<3>();
  for (int position = 0; position < state.active_count(); ++position) {
    const int row = InformationState::row_of(position);
    const int slot = state.active(position);
    const Eigen::Vector2d lever = seif::lever(state, slot, state.mean(slot));
    PtV.topRows<2>() += V.middleRows<2>(row);
    PtV.row(2) += lever.x() * V.row(row + 1) - lever.y() * V.row(row);
  }
  return scales.cwiseInverse().asDiagonal() * PtV;
}

/// D_f = D - D P (P' D P)^+ P' D. If D has no information about a mode, its eigenvalue is not larger than
/// rounding, with either sign. Such a mode is left as it is.
void float_window(InformationState& state) {
  auto D = state.work();
  auto V = state.work_columns();
  Eigen::Vector3d scales;
  apply_to_rigid_modes(state, D, V, scales);
  const Eigen::Matrix3d PtDP = project_on_rigid_modes(state, V, scales);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(0.5 * (PtDP + PtDP.transpose()));
  const double rounding = 1e-10 * D.diagonal().maxCoeff();
  Eigen::Matrix3d to_unit = modes.eigenvectors();
  for (int k = 0; k < 3; ++k) {
    const double eigenvalue = modes.eigenvalues()(k);
    to_unit.col(k) *= eigenvalue > rounding ? 1.0 / std::sqrt(eigenvalue) : 0.0;
  }
  for (Eigen::Index i = 0; i < V.rows(); ++i) V.row(i) = (V.row(i) * to_unit).eval();  // in place
  D.noalias() -= V * V.transpose();
  state.touch(state.window_blocks());
}

}  // namespace

std::optional<double> sparsify(InformationState& state, SparsificationRule rule, std::span<const int> slots) {
  assert(static_cast<int>(slots.size()) < state.active_count());
  std::optional<double> anchored = 0.0;
  state.work() = state.Omega() + state.frozen();
  if (rule != SparsificationRule::report) {
    if (!marginalise_landmarks(state, slots)) return std::nullopt;
    anchored = log_determinant(state.work().topLeftCorner<3, 3>());
    if (!anchored) return std::nullopt;
  }
  switch (rule) {
    case SparsificationRule::report:
      break;
    case SparsificationRule::gauge_free:
      state.work() = state.Omega() + state.frozen();
      float_window(state);
      break;
    case SparsificationRule::modified: {
      const std::optional<Eigen::MatrixXd> marginal = window_marginal(state);
      if (!marginal) return std::nullopt;
      state.work() = *marginal;
      state.touch(std::int64_t{state.landmark_count()});
      break;
    }
  }
  if (!drop_links(state, slots)) return std::nullopt;
  if (!state.keeps_frozen_apart()) {
    for (const int slot : slots) state.deactivate(state.position(slot));
  }
  if (rule == SparsificationRule::report) return 0.0;
  // drop_links() has factorised this block already: it is positive definite.
  return *anchored - log_determinant(state.Omega().topLeftCorner<3, 3>()).value();
}

void choose_to_drop(const InformationState& state, DropOrder order, int count, std::vector<int>& slots) {
  assert(count <= state.active_count());
  const auto age = [&](int slot) {
    switch (order) {
      case DropOrder::weakest_link:
        return 0;
      case DropOrder::weakest_out_of_view:
        return std::min(state.scans_since_seen(slot), 1);
      case DropOrder::least_recently_seen:
        return state.scans_since_seen(slot);
    }
    return 0;
  };
  const auto rank = [&](int slot) {
    const int row = InformationState::row_of(state.position(slot));
    return std::pair(-age(slot), state.Omega().block<3, 2>(0, row).squaredNorm());
  };
  slots.clear();
  for (int position = 0; position < state.active_count(); ++position) slots.push_back(state.active(position));
  std::ranges::partial_sort(slots, slots.begin() + count, {}, rank);
  slots.resize(static_cast<std::size_t>(count));
}

void choose_surplus(const InformationState& state, const LinkBounds& bounds, std::vector<int>& slots) {
  slots.clear();
  if (state.active_count() <= std::max(bounds.theta_x, bounds.theta_max)) return;
  choose_to_drop(state, bounds.order, state.active_count() - bounds.theta_x, slots);
  if (bounds.keep_in_view) {
    std::erase_if(slots, [&](int slot) { return state.scans_since_seen(slot) == 0; });
  }
}

}  // namespace seif
