#include "seif/relocation.hpp"

#include <Eigen/Cholesky>
#include <vector>

#include "seif/linearisation.hpp"

namespace seif {

/// Omega_mm -= Omega_mx Omega_xx^-1 Omega_xm, r_m -= Omega_mx Omega_xx^-1 r_x.
bool forget_robot(InformationState& state) {
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
  return true;
}

bool marginalise_robot(InformationState& state) {
  if (!forget_robot(state)) return false;
  while (state.active_count() > 0) state.deactivate(state.active_count() - 1);
  return true;
}

void add_surroundings(InformationState& state, const Relocation& relocation) {
  const Surroundings& surroundings = relocation.surroundings;
  const auto k = static_cast<Eigen::Index>(surroundings.size());
  std::vector<int> slots;
  for (const LandmarkId id : surroundings.landmarks) slots.push_back(state.find(id).value());
  for (const int slot : slots) {
    if (state.position(slot) < 0) state.activate(slot);
  }
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * k, state.window_size());
  Eigen::VectorXd v(2 * k);
  for (Eigen::Index i = 0; i < k; ++i) {
    const int slot = slots[static_cast<std::size_t>(i)];
    const Eigen::Vector2d mean = state.mean(slot);
    const ExpectedPlace expected = expect_place(state.pose(), mean, lever(state, slot, mean));
    J.block<2, 3>(2 * i, 0) = expected.J_x;
    J.block<2, 2>(2 * i, InformationState::row_of(state.position(slot))) = expected.J_m;
    v.segment<2>(2 * i) = surroundings.at(static_cast<std::size_t>(i)) - expected.p_robot;
  }
  const Eigen::LLT<Eigen::MatrixXd> C(surroundings.covariance);
  C.matrixL().solveInPlace(J);
  C.matrixL().solveInPlace(v);
  state.Omega() += J.transpose() * J;
  state.r() += J.transpose() * v;
  state.touch(state.window_blocks());
}

}  // namespace seif
