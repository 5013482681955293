#include "seif/observation_factor.hpp"

#include <Eigen/LU>
#include <cassert>

#include "seif/linearisation.hpp"

namespace seif {
namespace {

ObservationFactor unlinearised(const InformationState& state, int slot, const Eigen::Vector2d& mean,
                               const Observation& observation) {
  ObservationFactor factor;
  factor.slot = slot;
  factor.observation = observation;
  factor.Q_inverse = observation.covariance.inverse();
  factor.x0 = state.pose();
  factor.m0 = mean;
  return factor;
}

/// With first estimates: sets the column of J_x for the heading so that turning everything changes nothing.
/// Turning the pose then has the opposite effect of turning the landmark's first estimate about the pose's
/// first estimate. The landmark is taken to be at p_world_landmark.
void keep_null_space(const InformationState& state, const Eigen::Vector2d& p_world_landmark,
                     ObservationFactor& factor) {
  if (!state.first_estimates().in_use()) return;
  const Eigen::Vector2d lever = seif::lever(state, factor.slot, p_world_landmark);
  factor.J_x.col(2) = factor.J_m * Eigen::Vector2d(lever.y(), -lever.x());
}

void add_scaled(InformationState& state, const ObservationFactor& factor, double sign) {
  const int row = InformationState::row_of(state.position(factor.slot));
  const Eigen::Vector2d v = residual(state, factor);
  const Eigen::Matrix<double, 3, 2> C_x = sign * factor.J_x.transpose() * factor.Q_inverse;
  const Eigen::Matrix2d C_m = sign * factor.J_m.transpose() * factor.Q_inverse;
  const Eigen::Matrix<double, 3, 2> Omega_xm = C_x * factor.J_m;
  auto Omega = state.Omega();
  Omega.topLeftCorner<3, 3>() += C_x * factor.J_x;
  Omega.block<3, 2>(0, row) += Omega_xm;
  Omega.block<2, 3>(row, 0) += Omega_xm.transpose();
  Omega.block<2, 2>(row, row) += C_m * factor.J_m;
  state.r().head<3>() += C_x * v;
  state.r().segment<2>(row) += C_m * v;
  state.touch(3);
}

}  // namespace

ObservationFactor linearise(const InformationState& state, int slot, const Observation& observation,
                            const Pose2& T_robot_sensor) {
  return linearise(state, slot, state.mean(slot), observation, T_robot_sensor);
}

ObservationFactor linearise(const InformationState& state, int slot, const Eigen::Vector2d& mean,
                            const Observation& observation, const Pose2& T_robot_sensor) {
  ObservationFactor factor = unlinearised(state, slot, mean, observation);
  const PredictedObservation predicted = predict_observation(factor.x0, T_robot_sensor, factor.m0);
  factor.v = innovation(observation, predicted.z);
  factor.J_x = predicted.J_wrt_pose;
  factor.J_m = predicted.J_wrt_landmark;
  keep_null_space(state, factor.m0, factor);
  return factor;
}

ObservationFactor linearise_at_measurement(const InformationState& state, int slot,
                                           const Observation& observation, const Pose2& T_robot_sensor) {
  ObservationFactor factor = unlinearised(state, slot, state.mean(slot), observation);
  const Eigen::Vector2d seen_at = invert_observation(factor.x0, T_robot_sensor, observation).p_world_landmark;
  const PredictedObservation predicted = predict_observation(factor.x0, T_robot_sensor, seen_at);
  factor.J_x = predicted.J_wrt_pose;
  factor.J_m = predicted.J_wrt_landmark;
  factor.v = factor.J_m * (seen_at - factor.m0);  // at seen_at the innovation is zero
  keep_null_space(state, seen_at, factor);
  factor.at_measurement = true;
  return factor;
}

Eigen::Matrix2d covariance(const ObservationFactor& factor) {
  Eigen::Matrix2d Q = factor.observation.covariance;
  Q.diagonal() += factor.noise;
  return Q;
}

void set_noise(ObservationFactor& factor, const Eigen::Vector2d& noise) {
  factor.noise = noise;
  factor.Q_inverse = covariance(factor).inverse();
}

Eigen::Vector2d residual(const InformationState& state, const ObservationFactor& factor) {
  const Pose2 x = state.pose();
  const Eigen::Vector3d dx(x.x - factor.x0.x, x.y - factor.x0.y, wrap_angle(x.theta - factor.x0.theta));
  return factor.v - factor.J_x * dx - factor.J_m * (state.mean(factor.slot) - factor.m0);
}

double squared_norm(const Eigen::Vector2d& v, const ObservationFactor& factor) {
  return v.dot(factor.Q_inverse * v);
}

void add(InformationState& state, const ObservationFactor& factor) {
  if (state.position(factor.slot) < 0) state.activate(factor.slot);
  add_scaled(state, factor, 1.0);
}

void subtract(InformationState& state, const ObservationFactor& factor) {
  assert(state.position(factor.slot) >= 0);
  add_scaled(state, factor, -1.0);
}

}  // namespace seif
