// The motion model g and the measurement model h, with their Jacobians: one copy, used by every estimator.
#pragma once

#include <Eigen/Core>

#include "seif/types.hpp"

namespace seif {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

/// The pose after an increment, g(x, u), and its Jacobian and noise; eqs. (26), (29).
struct PredictedPose {
  Pose2 pose;                                                // T_world_robot after the increment
  Eigen::Matrix3d J_wrt_pose = Eigen::Matrix3d::Identity();  // F = I + A (3 x 3)
  /// L with L L' = R, in the world frame (3 x 3), any rank
  Eigen::Matrix3d noise_factor = Eigen::Matrix3d::Zero();
};

/// `odometry.covariance` must be positive semidefinite. Negative eigenvalues that come from rounding count as
/// zero.
PredictedPose predict_pose(const Pose2& T_world_robot, const Odometry& odometry);

/// Two successive motions as one, with the covariance to first order.
Odometry compose(const Odometry& first, const Odometry& second);

/// `Sigma` is the covariance of a pose and of landmarks, [x y theta m1x m1y ...]. Moves its pose by a motion,
/// to first order. (3+2k x 3+2k)
void move_pose(Eigen::MatrixXd& Sigma, const Pose2& pose, const Odometry& motion);

/// The expected observation h(x, m), and its Jacobians with respect to pose and landmark; eqs. (15), (23).
struct PredictedObservation {
  Eigen::Vector2d z = Eigen::Vector2d::Zero();               // range [m], bearing [rad]
  Matrix23 J_wrt_pose = Matrix23::Zero();                    // (2 x 3)
  Eigen::Matrix2d J_wrt_landmark = Eigen::Matrix2d::Zero();  // (2 x 2)
};

/// If the landmark is nearer than 1 cm, the Jacobian is the one at 1 cm: at the sensor itself the bearing has
/// no derivative.
PredictedObservation predict_observation(const Pose2& T_world_robot, const Pose2& T_robot_sensor,
                                         const Eigen::Vector2d& p_world_landmark);

/// z - z_hat with the bearing wrapped. [m, rad]
Eigen::Vector2d innovation(const Observation& observation, const Eigen::Vector2d& z_hat);

/// The position of a landmark that is observed in this way, and its Jacobians with respect to pose and
/// observation.
struct InverseObservation {
  Eigen::Vector2d p_world_landmark = Eigen::Vector2d::Zero();   // [m]
  Matrix23 J_wrt_pose = Matrix23::Zero();                       // (2 x 3)
  Eigen::Matrix2d J_wrt_observation = Eigen::Matrix2d::Zero();  // (2 x 2)
};

InverseObservation invert_observation(const Pose2& T_world_robot, const Pose2& T_robot_sensor,
                                      const Observation& observation);

/// The inverse of Huber's weight [-]: the Mahalanobis distance divided by `robust_above` [sigma] if this ratio
/// is above 1, else 1. Always 1 if `robust_above` is 0.
double huber_excess(double squared_distance, double robust_above);

}  // namespace seif
