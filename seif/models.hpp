// The motion model g and the measurement model h, with their Jacobians: one copy, used by every estimator.
#pragma once

#include <Eigen/Core>

#include "seif/types.hpp"

namespace seif {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

/// The pose after an increment, g(x, u), and how it depends on pose and increment; eqs. (26), (29).
struct PredictedPose {
  Pose2 pose;                                                // T_world_robot after the increment
  Eigen::Matrix3d J_wrt_pose = Eigen::Matrix3d::Identity();  // F = I + A (3 x 3)
  Eigen::Matrix3d noise_factor =
      Eigen::Matrix3d::Zero();  // L with L L' = R, in the world frame (3 x 3), any rank
};

/// `odometry.covariance` must be positive semidefinite; rounding below zero is taken as zero.
PredictedPose predict_pose(const Pose2& T_world_robot, const Odometry& odometry);

/// What the sensor should see, h(x, m), and how it depends on pose and landmark; eqs. (15), (23).
struct PredictedObservation {
  Eigen::Vector2d z = Eigen::Vector2d::Zero();               // range [m], bearing [rad]
  Matrix23 J_wrt_pose = Matrix23::Zero();                    // (2 x 3)
  Eigen::Matrix2d J_wrt_landmark = Eigen::Matrix2d::Zero();  // (2 x 2)
};

/// The Jacobian is that at 1 cm where the landmark is nearer: at the sensor itself a bearing has none.
PredictedObservation predict_observation(const Pose2& T_world_robot, const Pose2& T_robot_sensor,
                                         const Eigen::Vector2d& p_world_landmark);

/// z - z_hat with the bearing wrapped. [m, rad]
Eigen::Vector2d innovation(const Observation& observation, const Eigen::Vector2d& z_hat);

/// Where a landmark must be that is seen so, and how that depends on pose and observation.
struct InverseObservation {
  Eigen::Vector2d p_world_landmark = Eigen::Vector2d::Zero();   // [m]
  Matrix23 J_wrt_pose = Matrix23::Zero();                       // (2 x 3)
  Eigen::Matrix2d J_wrt_observation = Eigen::Matrix2d::Zero();  // (2 x 2)
};

InverseObservation invert_observation(const Pose2& T_world_robot, const Pose2& T_robot_sensor,
                                      const Observation& observation);

/// The inverse of Huber's weight: the Mahalanobis distance over `robust_above` [sigma] where it is larger, else 1;
/// 1 if `robust_above` is 0. [-]
double huber_excess(double squared_distance, double robust_above);

}  // namespace seif
