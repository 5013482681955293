#include "seif/sparsification.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <utility>

namespace seif {
namespace {

using Columns = Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, 3>>;
using LLT3 = Eigen::LLT<Eigen::Matrix3d>;

/// Marginalises the landmark at `row` out of M: M -= M_:m M_mm^-1 M_m:. False if M_mm is not positive
/// definite.
bool marginalise_landmark(Eigen::Ref<Eigen::MatrixXd> M, int row, Columns columns) {
  const Eigen::LLT<Eigen::Matrix2d> llt(Eigen::Matrix2d(M.block<2, 2>(row, row)));
  if (llt.info() != Eigen::Success) return false;
  auto V = columns.leftCols<2>();  // (w x 2)
  V = M.middleCols<2>(row);
  llt.matrixU().solveInPlace<Eigen::OnTheRight>(V);
  M.noalias() -= V * V.transpose();
  return true;
}

}  // namespace

bool sparsify_report(InformationState& state, std::span<const int> slots) {
  // With H0 = the window's block of H, and x, K, Z the robot and the landmarks that stay and that go, (50) is
  //   [Lambda X] = rows x of the marginal of H0 over (x, K),
  //   H_mm -= H_mx H_xx^-1 H_xm  (H3: the robot marginalised out; m all landmarks of the window),
  //   H_xx = Lambda, H_xK = X, H_xZ = 0, H_KK += X' Lambda^-1 X.
  auto Omega = state.Omega();
  auto M = state.work();          // (w x w)
  auto V = state.work_columns();  // (w x 3)
  M = Omega;
  for (const int slot : slots) {
    const int row = InformationState::row_of(state.position(slot));
    if (!marginalise_landmark(M, row, V)) return false;
    M.topRows<3>().middleCols<2>(row).setZero();  // zero but for rounding
  }
  const LLT3 Omega_xx(Eigen::Matrix3d(Omega.topLeftCorner<3, 3>()));
  const LLT3 Lambda(Eigen::Matrix3d(M.topLeftCorner<3, 3>()));
  if (Omega_xx.info() != Eigen::Success || Lambda.info() != Eigen::Success) return false;

  const auto rows = Omega.rows() - 3;
  auto Omega_mm = Omega.bottomRightCorner(rows, rows);
  auto V_m = V.bottomRows(rows);
  V_m = Omega.bottomLeftCorner(rows, 3);
  Omega_xx.matrixU().solveInPlace<Eigen::OnTheRight>(V_m);
  Omega_mm.noalias() -= V_m * V_m.transpose();

  Omega.topRows<3>() = M.topRows<3>();
  Omega.bottomLeftCorner(rows, 3) = M.topRightCorner(3, rows).transpose();
  V_m = Omega.bottomLeftCorner(rows, 3);
  Lambda.matrixU().solveInPlace<Eigen::OnTheRight>(V_m);
  Omega_mm.noalias() += V_m * V_m.transpose();
  state.touch((static_cast<int>(slots.size()) + 2) * state.window_blocks());
  for (const int slot : slots) state.deactivate(state.position(slot));
  return true;
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

}  // namespace seif
