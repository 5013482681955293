#include "seif/relocation.hpp"

#include <Eigen/Cholesky>

namespace seif {

/// Omega_mm -= Omega_mx Omega_xx^-1 Omega_xm, r_m -= Omega_mx Omega_xx^-1 r_x.
bool marginalise_robot(InformationState& state) {
  auto Omega = state.Omega();
  auto r = state.r();
  const Eigen::LLT<Eigen::Matrix3d> Omega_xx(Eigen::Matrix3d(Omega.topLeftCorner<3, 3>()));
  if (Omega_xx.info() != Eigen::Success) return false;

  const auto landmarks = Omega.rows() - 3;
  auto V = state.work_columns().bottomRows(landmarks);  // (2k x 3)
  V = Omega.bottomLeftCorner(landmarks, 3);
  const Eigen::Vector3d step = Omega_xx.solve(r.head<3>());
  r.tail(landmarks).noalias() -= V * step;
  Omega_xx.matrixU().solveInPlace<Eigen::OnTheRight>(V);
  Omega.bottomRightCorner(landmarks, landmarks).noalias() -= V * V.transpose();
  Omega.topRows<3>().setZero();
  Omega.leftCols<3>().setZero();
  r.head<3>().setZero();
  state.touch(state.window_blocks());
  while (state.active_count() > 0) state.deactivate(state.active_count() - 1);
  return true;
}

}  // namespace seif
