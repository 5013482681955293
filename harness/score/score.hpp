// Scores of trajectories, maps and beliefs against the truth, from plain values. Definitions: docs/scores.md.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "seif/types.hpp"

namespace harness {

/// The estimated and the true pose at one time.
struct PosePair {
  double t = 0.0;         // [s]
  seif::Pose2 est_pose;   // T_world_robot
  seif::Pose2 true_pose;  // T_world_robot
};

/// The estimated and the true position of a landmark.
struct PointPair {
  Eigen::Vector2d est_point = Eigen::Vector2d::Zero();   // p_world [m]
  Eigen::Vector2d true_point = Eigen::Vector2d::Zero();  // p_world [m]
};

/// Root mean square distance between estimated and true points; empty if there are no points.
struct PointScore {
  std::optional<double> rmse;          // [m] without alignment
  std::optional<double> rmse_aligned;  // [m] after the rigid motion that brings the points closest
};

PointScore score_points(std::span<const PointPair> points);

/// The absolute trajectory error (ATE): the error of the positions.
PointScore absolute_trajectory_error(std::span<const PosePair> poses);

/// Root mean square error of the motion over an interval.
struct RelativePoseError {
  std::optional<double> translation;  // [m]
  std::optional<double> rotation;     // [rad]
};

/// The error over all pairs of poses that are `interval` [s] apart, within a tenth of it. `poses` are in the
/// order of time.
RelativePoseError relative_pose_error(std::span<const PosePair> poses, double interval);

/// The same over all pairs that are `distance` [m] apart along the true path.
RelativePoseError relative_pose_error_along_path(std::span<const PosePair> poses, double distance);

/// For each value `v`, the later value nearest to `v + apart`, as a pair of indices. The first of equal
/// values counts. A pair that misses `apart` by more than a tenth is left out. `values` are ascending or
/// equal, and `apart` is positive.
std::vector<std::pair<std::size_t, std::size_t>> pairs_apart(std::span<const double> values, double apart);

/// Root mean square distance between points in the robot's frame: the estimated point in the estimated frame,
/// the true point in the true frame. Empty if there are no points. [m]
std::optional<double> rmse_from_robot(std::span<const PointPair> points, const PosePair& pose);

/// The normalised estimation error squared, per degree of freedom: error' covariance^-1 error / n. A
/// consistent filter has 1. Empty if the covariance is not positive definite.
std::optional<double> nees(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance);
std::optional<double> nees(const Eigen::Vector2d& error, const Eigen::Matrix2d& covariance);
std::optional<double> nees(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance);

/// Estimate minus truth, (3 x 1) [m, m, rad]. The error of the heading is in (-pi, pi].
Eigen::Vector3d pose_error(const seif::Pose2& est_pose, const seif::Pose2& true_pose);

/// Percentiles of a sample by the nearest rank: the smallest value that at least this share of the sample
/// does not exceed.
struct Percentiles {
  double p50 = 0.0;
  double p95 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

/// Empty if there are no values. Sorts `values`.
std::optional<Percentiles> percentiles(std::span<double> values);

/// At most `most` indices out of `count`, ascending, spread evenly. The same arguments give the same indices.
std::vector<std::size_t> spread_sample(std::size_t count, std::size_t most);

}  // namespace harness
