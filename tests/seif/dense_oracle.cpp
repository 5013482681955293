#include "dense_oracle.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "seif/full_state.hpp"

namespace seif::oracle {

Eigen::MatrixXd symmetric(const Eigen::SparseMatrix<double>& lower) {
  return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
}

DenseBelief dense(const InformationState& state) {
  DenseBelief belief{.H = symmetric(full_Omega(state)), .b = {}, .mu = full_mu(state)};
  belief.b = full_r(state) + belief.H * belief.mu;
  return belief;
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& M) { return M.inverse(); }

Eigen::VectorXd solve(const Eigen::MatrixXd& M, const Eigen::VectorXd& v) { return M.ldlt().solve(v); }

void recover_mean(DenseBelief& belief) { belief.mu = solve(belief.H, belief.b); }

void recover_mean(InformationState& state) {
  move_all(state, solve(symmetric(full_Omega(state)), full_r(state)));
}

Pose2 pose_of(const DenseBelief& belief) { return {belief.mu(0), belief.mu(1), belief.mu(2)}; }

void motion_update(DenseBelief& belief, const Odometry& odometry) {
  const PredictedPose predicted = predict_pose(pose_of(belief), odometry);
  const auto n = belief.H.rows();
  Eigen::MatrixXd I_plus_A = Eigen::MatrixXd::Identity(n, n);
  I_plus_A.topLeftCorner<3, 3>() = predicted.J_wrt_pose;
  Eigen::MatrixXd SUS = Eigen::MatrixXd::Zero(n, n);
  SUS.topLeftCorner<3, 3>() = predicted.noise_factor * predicted.noise_factor.transpose();
  const Eigen::MatrixXd H_inverse = inverse(belief.H);
  const Eigen::VectorXd mean = H_inverse * belief.b;
  // The mean of (34) is that of the linearised motion, g(mu) + (I + A)(mean - mu), since mu is only
  // approximately the mean.
  Eigen::VectorXd moved = belief.mu;
  moved.head<3>() << predicted.pose.x, predicted.pose.y, predicted.pose.theta;
  belief.H = inverse(I_plus_A * H_inverse * I_plus_A.transpose() + SUS);
  belief.b = belief.H * (moved + I_plus_A * (mean - belief.mu));
  belief.mu = moved;
}

void add_landmark(DenseBelief& belief, const Eigen::Vector2d& mean) {
  const auto n = belief.H.rows();
  belief.H.conservativeResizeLike(Eigen::MatrixXd::Zero(n + 2, n + 2));
  belief.b.conservativeResizeLike(Eigen::VectorXd::Zero(n + 2));
  belief.mu.conservativeResize(n + 2);
  belief.mu.tail<2>() = mean;
}

void measurement_update(DenseBelief& belief, int slot, const Observation& observation,
                        const Pose2& T_robot_sensor) {
  const int row = InformationState::row_of(slot);
  const PredictedObservation predicted =
      predict_observation(pose_of(belief), T_robot_sensor, belief.mu.segment<2>(row));
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(belief.H.rows(), 2);
  C.topRows<3>() = predicted.J_wrt_pose.transpose();
  C.middleRows<2>(row) = predicted.J_wrt_landmark.transpose();
  const Eigen::Matrix2d Z_inverse = observation.covariance.inverse();
  belief.H += C * Z_inverse * C.transpose();
  belief.b += C * Z_inverse * (innovation(observation, predicted.z) + C.transpose() * belief.mu);
}

Eigen::MatrixXd projection(Eigen::Index n, bool robot, const std::vector<int>& slots) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n, (robot ? 3 : 0) + 2 * static_cast<int>(slots.size()));
  int col = 0;
  if (robot) {
    S.topLeftCorner<3, 3>().setIdentity();
    col = 3;
  }
  for (const int slot : slots) {
    S.block<2, 2>(InformationState::row_of(slot), col).setIdentity();
    col += 2;
  }
  return S;
}

Eigen::MatrixXd taken_away(const Eigen::MatrixXd& H, const Eigen::MatrixXd& S) {
  return H * S * inverse(S.transpose() * H * S) * S.transpose() * H;
}

Eigen::MatrixXd conditioned(const Eigen::MatrixXd& H, const std::vector<int>& active) {
  const Eigen::MatrixXd S = projection(H.rows(), true, active);
  return S * S.transpose() * H * S * S.transpose();
}

Eigen::MatrixXd marginalised(const Eigen::MatrixXd& H, const std::vector<int>& active) {
  const Eigen::MatrixXd S = projection(H.rows(), true, active);
  return S * inverse(S.transpose() * inverse(H) * S) * S.transpose();
}

Eigen::MatrixXd floated(const Eigen::MatrixXd& H, const Eigen::VectorXd& mu, const std::vector<int>& active) {
  const Eigen::MatrixXd S = projection(H.rows(), true, active);
  const Eigen::MatrixXd D = S.transpose() * H * S;
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(D.rows(), 3);
  P.topRows<3>().setIdentity();
  for (std::size_t i = 0; i < active.size(); ++i) {
    const Eigen::Vector2d lever = mu.segment<2>(InformationState::row_of(active[i])) - mu.head<2>();
    P.middleRows<2>(3 + 2 * static_cast<int>(i)) << 1, 0, -lever.y(), 0, 1, lever.x();
  }
  const Eigen::MatrixXd D_f = D - D * P * inverse(P.transpose() * D * P) * P.transpose() * D;
  return S * D_f * S.transpose();
}

Eigen::MatrixXd sparsified(const Eigen::MatrixXd& H, const Eigen::MatrixXd& H0,
                           const std::vector<int>& dropped) {
  const auto n = H.rows();
  return H - taken_away(H0, projection(n, false, dropped)) + taken_away(H0, projection(n, true, dropped)) -
         taken_away(H, projection(n, true, {}));
}

Odometry RandomDrive::odometry() {
  Odometry u;
  u.T_previous_current = {uniform(0.1, 0.5), uniform(-0.02, 0.02), uniform(-0.4, 0.4)};
  Eigen::Matrix<double, 3, 2> L;  // rank 2, as a differential drive's
  L << 0.02, 0.01, 0.001, -0.002, 0.01, -0.02;
  u.covariance = L * L.transpose();
  return u;
}

Observation RandomDrive::observation(LandmarkId landmark, const Pose2& T_world_sensor,
                                     const Eigen::Vector2d& p_world) {
  const Eigen::Vector2d p = inverse(T_world_sensor) * p_world;
  Observation z{
      .landmark = landmark, .range = p.norm() + uniform(-0.05, 0.05), .bearing = 0.0, .covariance = {}};
  z.bearing = wrap_angle(std::atan2(p.y(), p.x()) + uniform(-0.02, 0.02));
  z.covariance << 0.0025, 0.0002, 0.0002, 0.0004;
  return z;
}

}  // namespace seif::oracle
