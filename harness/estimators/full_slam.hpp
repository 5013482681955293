// The full SLAM problem of a recorded stream (all poses and all landmarks at once), and its least-squares
// optimum.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "seif/types.hpp"

namespace harness {

/// An observation of a landmark from a pose. Poses and landmarks are numbered from 0.
struct Sighting {
  int pose = 0;
  int landmark = 0;
  seif::Pose2 T_pose_sensor;
  seif::Observation observation;
};

/// The measurements of the problem. Terms are weighted by the inverse of their covariances.
struct FullSlam {
  seif::PoseEstimate start;             // of pose 0
  std::vector<seif::Odometry> motions;  // from pose i to pose i + 1
  std::vector<Sighting> sightings;      // in the order of their poses
  int landmark_count = 0;
  double robust_above = 0.0;  // [sigma] larger residuals of sightings count less (Cauchy); 0: all count fully

  int pose_count() const { return static_cast<int>(motions.size()) + 1; }
  int row_of_pose(int pose) const { return 3 * pose; }
  int row_of_landmark(int landmark) const { return 3 * pose_count() + 2 * landmark; }
};

struct FullSlamOptimum {
  std::vector<seif::Pose2> poses;          // T_world_robot
  std::vector<Eigen::Vector2d> landmarks;  // p_world_landmark [m]
  Eigen::SparseMatrix<double> Omega;       // J' J at the optimum, lower triangle; poses, then landmarks
};

/// True if a motion is so certain that observations after it can count as made before it.
bool is_certain(const seif::Odometry& motion);

/// The inverse of a motion's covariance of any rank. No direction is known better than to 3e-6 m or rad.
Eigen::Matrix3d information_of_motion(const Eigen::Matrix3d& covariance);

/// The poses for a map that is assumed known, by an extended Kalman filter of the pose.
std::vector<seif::Pose2> poses_on_map(const FullSlam& slam, std::span<const Eigen::Vector2d> landmarks);

/// Minimises the sum of squared residuals from an initial guess. Throws std::runtime_error if this does not
/// converge.
FullSlamOptimum optimum(const FullSlam& slam, std::span<const seif::Pose2> poses,
                        std::span<const Eigen::Vector2d> landmarks);

}  // namespace harness
