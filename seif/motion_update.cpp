#include "seif/motion_update.hpp"

#include <Eigen/Cholesky>

#include "seif/linearisation.hpp"
#include "seif/models.hpp"

namespace seif {
namespace {

/// Omega' = Psi' Omega Psi and r' = Psi' r; Probabilistic Robotics, (12.12), (12.13). Psi = F^-1 differs from
/// the identity only in two entries of the robot's block: the derivatives of x and y with respect to the
/// heading, with the sign changed.
void change_pose_variable(InformationState& state, const Eigen::Matrix3d& F) {
  const double psi_x = -F(0, 2);
  const double psi_y = -F(1, 2);
  auto Omega = state.Omega();
  auto r = state.r();
  Omega.col(2) += psi_x * Omega.col(0) + psi_y * Omega.col(1);
  Omega.row(2) += psi_x * Omega.row(0) + psi_y * Omega.row(1);
  r(2) += psi_x * r(0) + psi_y * r(1);
}

/// (Omega'^-1 + S_x L L' S_x')^-1 = Omega' - A (I + L' A_x)^-1 A'  with A = Omega' S_x L,
/// r_bar = r' - A (I + L' A_x)^-1 L' r'_x.
/// S_x picks the rows of the robot. This form does not need the inverse of the noise, which does not exist for
/// a differential drive.
void add_motion_noise(InformationState& state, const Eigen::Matrix3d& L) {
  auto Omega = state.Omega();
  auto r = state.r();
  auto A = state.work_columns();  // (w x 3)
  A.noalias() = Omega.leftCols<3>() * L;
  const Eigen::LLT<Eigen::Matrix3d> llt(Eigen::Matrix3d::Identity() + L.transpose() * A.topRows<3>());
  const Eigen::Vector3d shift = llt.solve(L.transpose() * r.head<3>());
  r.noalias() -= A * shift;
  llt.matrixU().solveInPlace<Eigen::OnTheRight>(A);  // now A A' is the whole change
  Omega.noalias() -= A * A.transpose();
}

/// Without this step, rounding makes the robot's rows lose their symmetry, and then Omega its definiteness; the
/// error grows exponentially.
void symmetrise_robot_rows(InformationState& state) {
  auto Omega = state.Omega();
  auto Omega_xx = Omega.topLeftCorner<3, 3>();
  Omega_xx = (0.5 * (Omega_xx + Omega_xx.transpose())).eval();
  const auto landmarks = Omega.rows() - 3;
  Omega.topRightCorner(3, landmarks) = Omega.bottomLeftCorner(landmarks, 3).transpose();
}

}  // namespace

void motion_update(InformationState& state, const Odometry& odometry) {
  const PredictedPose predicted = predict_pose(state.pose(), odometry);
  const Eigen::Vector2d moved = move_to_prediction(state, predicted.pose);
  Eigen::Matrix3d F = predicted.J_wrt_pose;
  if (state.first_estimates().in_use()) F.topRightCorner<2, 1>() << -moved.y(), moved.x();
  change_pose_variable(state, F);
  add_motion_noise(state, predicted.noise_factor);
  symmetrise_robot_rows(state);
  state.touch(state.window_blocks());
}

}  // namespace seif
