#include "seif/measurement_update.hpp"

#include <Eigen/LU>
#include <optional>

#include "seif/models.hpp"

namespace seif {
namespace {

/// Omega += C Q^-1 C' and, as r = xi - Omega mu, (22) becomes r += C Q^-1 (z - z_hat).
void add_observation(InformationState& state, int slot, const Observation& observation,
                     const Pose2& T_robot_sensor) {
  const int position = state.position(slot) < 0 ? state.activate(slot) : state.position(slot);
  const int row = InformationState::row_of(position);
  const PredictedObservation predicted = predict_observation(state.pose(), T_robot_sensor, state.mean(slot));
  const Eigen::Vector2d v = innovation(observation, predicted.z);
  const Eigen::Matrix2d Q_inverse = observation.covariance.inverse();
  const Eigen::Matrix<double, 3, 2> C_x = predicted.J_wrt_pose.transpose() * Q_inverse;
  const Eigen::Matrix2d C_m = predicted.J_wrt_landmark.transpose() * Q_inverse;

  auto Omega = state.Omega();
  const Eigen::Matrix<double, 3, 2> Omega_xm = C_x * predicted.J_wrt_landmark;
  Omega.topLeftCorner<3, 3>() += C_x * predicted.J_wrt_pose;
  Omega.block<3, 2>(0, row) += Omega_xm;
  Omega.block<2, 3>(row, 0) += Omega_xm.transpose();
  Omega.block<2, 2>(row, row) += C_m * predicted.J_wrt_landmark;
  state.r().head<3>() += C_x * v;
  state.r().segment<2>(row) += C_m * v;
  state.touch(3);
}

}  // namespace

int measurement_update(InformationState& state, std::span<const Observation> observations,
                       const Pose2& T_robot_sensor) {
  const int known = state.landmark_count();
  state.begin_scan();
  for (const Observation& observation : observations) {
    std::optional<int> slot = state.find(observation.landmark);
    if (!slot) {
      slot =
          state.add_landmark(observation.landmark,
                             invert_observation(state.pose(), T_robot_sensor, observation).p_world_landmark);
    }
    state.mark_seen(*slot);
    add_observation(state, *slot, observation, T_robot_sensor);
  }
  return state.landmark_count() - known;
}

}  // namespace seif
