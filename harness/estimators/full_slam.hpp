// The full SLAM problem of a recorded stream, with every pose and every landmark, and its least-squares optimum.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "seif/types.hpp"

namespace harness {

/// A landmark as it was seen from a pose. Both are given by their numbers, from 0.
struct Sighting {
  int pose = 0;
  int landmark = 0;
  seif::Pose2 T_pose_sensor;
  seif::Observation observation;
};

/// The terms of the optimisation, weighted by their covariances.
struct FullSlam {
  seif::PoseEstimate start;             // of pose 0
  std::vector<seif::Odometry> motions;  // from pose i to pose i + 1
  std::vector<Sighting> sightings;      // in the order of their poses
  int landmark_count = 0;
  double robust_above = 0.0;  // [sigma] sightings that are further off weigh less (Cauchy); 0: none does

  int pose_count() const { return static_cast<int>(motions.size()) + 1; }
  int row_of_pose(int pose) const { return 3 * pose; }
  int row_of_landmark(int landmark) const { return 3 * pose_count() + 2 * landmark; }
};

struct FullSlamOptimum {
  std::vector<seif::Pose2> poses;          // T_world_robot
  std::vector<Eigen::Vector2d> landmarks;  // p_world_landmark [m]
  Eigen::SparseMatrix<double> Omega;       // J' J there, lower triangle; rows: the poses, then the landmarks
};

/// Two motions in a row as one, its covariance to first order.
seif::Odometry compose(const seif::Odometry& first, const seif::Odometry& second);

/// Propagates the covariance of a pose and landmarks, [x y theta m1x m1y ...], through a motion from this pose,
/// to first order. (3+2k x 3+2k)
void move_pose(Eigen::MatrixXd& Sigma, const seif::Pose2& pose, const seif::Odometry& motion);

/// Whether a motion is so certain that observations after it may count as observations from its beginning.
bool is_certain(const seif::Odometry& motion);

/// The inverse of a motion's covariance, whatever its rank: no direction is known better than to 3e-6 m or
/// rad.
Eigen::Matrix3d information_of_motion(const Eigen::Matrix3d& covariance);

/// The poses for a known map, by an extended Kalman filter of the pose alone.
std::vector<seif::Pose2> poses_on_map(const FullSlam& slam, std::span<const Eigen::Vector2d> landmarks);

/// Minimises the sum of squared residuals from a first guess. Throws std::runtime_error if it does not converge.
FullSlamOptimum optimum(const FullSlam& slam, std::span<const seif::Pose2> poses,
                        std::span<const Eigen::Vector2d> landmarks);

}  // namespace harness
