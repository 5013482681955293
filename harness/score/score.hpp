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

/// A pose as estimated and as it was, at one time.
struct PosePair {
  double t = 0.0;         // [s]
  seif::Pose2 est_pose;   // T_world_robot
  seif::Pose2 true_pose;  // T_world_robot
};

/// A landmark as estimated and as it is.
struct PointPair {
  Eigen::Vector2d est_point = Eigen::Vector2d::Zero();   // p_world [m]
  Eigen::Vector2d true_point = Eigen::Vector2d::Zero();  // p_world [m]
};

/// Root mean square distance of points; nothing without points.
struct PointScore {
  std::optional<double> rmse;          // [m] without alignment
  std::optional<double> rmse_aligned;  // [m] after the rigid motion that brings them closest to the truth
};

PointScore score_points(std::span<const PointPair> points);

/// Absolute trajectory error: of the positions.
PointScore absolute_trajectory_error(std::span<const PosePair> poses);

/// Root mean square of the error of motions over an interval.
struct RelativePoseError {
  std::optional<double> translation;  // [m]
  std::optional<double> rotation;     // [rad]
};

/// Over all pairs of poses that are `interval` [s] apart, within a tenth. Poses in the order of time.
RelativePoseError relative_pose_error(std::span<const PosePair> poses, double interval);

/// The same over all pairs that are `distance` [m] apart along the true path.
RelativePoseError relative_pose_error_along_path(std::span<const PosePair> poses, double distance);

/// Pairs of indices: for each value the later one that is nearest to `apart` more than it, the first of equals.
/// A pair whose distance differs from `apart` by more than a tenth is left out. The values never fall, and
/// `apart` is more than zero.
std::vector<std::pair<std::size_t, std::size_t>> pairs_apart(std::span<const double> values, double apart);

/// Root mean square distance of points as seen from the robot, each pair from its own pose; nothing without
/// points. [m]
std::optional<double> rmse_from_robot(std::span<const PointPair> points, const PosePair& pose);

/// Normalised estimation error squared for each degree of freedom: error' covariance^-1 error / n. 1 is
/// right. Nothing if the covariance is not positive definite.
std::optional<double> nees(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance);
std::optional<double> nees(const Eigen::Vector2d& error, const Eigen::Matrix2d& covariance);
std::optional<double> nees(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance);

/// Estimate minus truth; the heading's in (-pi, pi]. (3 x 1) [m, m, rad]
Eigen::Vector3d pose_error(const seif::Pose2& est_pose, const seif::Pose2& true_pose);

/// Percentiles of a sample by the nearest rank: the smallest value that at least this share of the values does
/// not exceed.
struct Percentiles {
  double p50 = 0.0;
  double p95 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

/// Nothing without values. Sorts them.
std::optional<Percentiles> percentiles(std::span<double> values);

/// Indices of at most `most` out of `count` things, spread evenly and always the same, ascending.
std::vector<std::size_t> spread_sample(std::size_t count, std::size_t most);

}  // namespace harness
