#include "seif/models.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace seif {
namespace {

constexpr double nearest_linearised_range = 0.01;  // [m]

/// v turned by +90 degrees: d/dtheta of R(theta) w where v = R(theta) w.
Eigen::Vector2d perpendicular(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// M with M M' = covariance, also for a singular covariance: a differential drive's has rank 2, and rank 0 at
/// rest.
Eigen::Matrix3d square_root(const Eigen::Matrix3d& covariance) {
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(covariance);
  const Eigen::Vector3d pivots = ldlt.vectorD().cwiseMax(0.0).cwiseSqrt();
  const Eigen::Matrix3d unit_lower = ldlt.matrixL();
  return ldlt.transpositionsP().transpose() * Eigen::Matrix3d(unit_lower * pivots.asDiagonal());
}

}  // namespace

PredictedPose predict_pose(const Pose2& T_world_robot, const Odometry& odometry) {
  PredictedPose predicted;
  predicted.pose = T_world_robot * odometry.T_previous_current;
  predicted.J_wrt_pose(0, 2) = -(predicted.pose.y - T_world_robot.y);
  predicted.J_wrt_pose(1, 2) = predicted.pose.x - T_world_robot.x;

  Eigen::Matrix3d J_wrt_increment = Eigen::Matrix3d::Identity();
  const double c = std::cos(T_world_robot.theta);
  const double s = std::sin(T_world_robot.theta);
  J_wrt_increment.topLeftCorner<2, 2>() << c, -s, s, c;
  predicted.noise_factor = J_wrt_increment * square_root(odometry.covariance);
  return predicted;
}

Odometry compose(const Odometry& first, const Odometry& second) {
  const PredictedPose predicted = predict_pose(first.T_previous_current, second);
  const Eigen::Matrix3d& F = predicted.J_wrt_pose;
  const Eigen::Matrix3d& L = predicted.noise_factor;
  return {second.t, predicted.pose, F * first.covariance * F.transpose() + L * L.transpose()};
}

void move_pose(Eigen::MatrixXd& Sigma, const Pose2& pose, const Odometry& motion) {
  const PredictedPose predicted = predict_pose(pose, motion);
  const Eigen::Matrix3d& L = predicted.noise_factor;
  Sigma.topRows<3>() = (predicted.J_wrt_pose * Sigma.topRows<3>()).eval();
  Sigma.leftCols<3>() = (Sigma.leftCols<3>() * predicted.J_wrt_pose.transpose()).eval();
  Sigma.topLeftCorner<3, 3>() += L * L.transpose();
}

PredictedObservation predict_observation(const Pose2& T_world_robot, const Pose2& T_robot_sensor,
                                         const Eigen::Vector2d& p_world_landmark) {
  const Pose2 T_world_sensor = T_world_robot * T_robot_sensor;
  const Eigen::Vector2d lever(T_world_sensor.x - T_world_robot.x, T_world_sensor.y - T_world_robot.y);
  const Eigen::Vector2d delta = p_world_landmark - Eigen::Vector2d(T_world_sensor.x, T_world_sensor.y);
  const double range = delta.norm();

  PredictedObservation predicted;
  predicted.z << range, wrap_angle(std::atan2(delta.y(), delta.x()) - T_world_sensor.theta);

  const double r = std::max(range, nearest_linearised_range);
  const Eigen::Vector2d along = range > 0.0 ? Eigen::Vector2d(delta / range) : Eigen::Vector2d::UnitX();
  const Eigen::Vector2d across = perpendicular(along);
  predicted.J_wrt_landmark << along.transpose(), across.transpose() / r;
  predicted.J_wrt_pose.leftCols<2>() = -predicted.J_wrt_landmark;
  predicted.J_wrt_pose.col(2) = -predicted.J_wrt_landmark * perpendicular(lever) - Eigen::Vector2d::UnitY();
  return predicted;
}

Eigen::Vector2d innovation(const Observation& observation, const Eigen::Vector2d& z_hat) {
  return {observation.range - z_hat.x(), wrap_angle(observation.bearing - z_hat.y())};
}

InverseObservation invert_observation(const Pose2& T_world_robot, const Pose2& T_robot_sensor,
                                      const Observation& observation) {
  const Pose2 T_world_sensor = T_world_robot * T_robot_sensor;
  const double angle = T_world_sensor.theta + observation.bearing;
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));

  InverseObservation inverse;
  inverse.p_world_landmark = Eigen::Vector2d(T_world_sensor.x, T_world_sensor.y) + observation.range * along;
  const Eigen::Vector2d lever = inverse.p_world_landmark - Eigen::Vector2d(T_world_robot.x, T_world_robot.y);
  inverse.J_wrt_pose << Eigen::Matrix2d::Identity(), perpendicular(lever);
  inverse.J_wrt_observation << along, observation.range * perpendicular(along);
  return inverse;
}

double huber_excess(double squared_distance, double above) {
  if (above <= 0.0 || squared_distance <= above * above) return 1.0;
  return std::sqrt(squared_distance) / above;
}

}  // namespace seif
