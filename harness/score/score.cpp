#include "harness/score/score.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "harness/statistics/alignment.hpp"

namespace harness {

namespace {

double root_mean_square(double sum_of_squares, std::size_t count) {
  return std::sqrt(sum_of_squares / static_cast<double>(count));
}

template <class Vector, class Matrix>
std::optional<double> nees_per_dof(const Vector& error, const Matrix& covariance) {
  const Eigen::LLT<Matrix> llt(covariance);
  if (llt.info() != Eigen::Success) return std::nullopt;
  const double value = error.dot(llt.solve(error)) / static_cast<double>(error.size());
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

RelativePoseError error_of_motions(std::span<const PosePair> poses,
                                   std::span<const std::pair<std::size_t, std::size_t>> pairs) {
  if (pairs.empty()) return {};
  double translation = 0.0;
  double rotation = 0.0;
  for (const auto& [i, j] : pairs) {
    const seif::Pose2 true_motion = inverse(poses[i].true_pose) * poses[j].true_pose;
    const seif::Pose2 est_motion = inverse(poses[i].est_pose) * poses[j].est_pose;
    const seif::Pose2 error = inverse(true_motion) * est_motion;
    translation += error.x * error.x + error.y * error.y;
    rotation += error.theta * error.theta;
  }
  return {root_mean_square(translation, pairs.size()), root_mean_square(rotation, pairs.size())};
}

}  // namespace

PointScore score_points(std::span<const PointPair> points) {
  if (points.empty()) return {};
  std::vector<Eigen::Vector2d> est_points;
  std::vector<Eigen::Vector2d> true_points;
  double raw = 0.0;
  for (const PointPair& pair : points) {
    est_points.push_back(pair.est_point);
    true_points.push_back(pair.true_point);
    raw += (pair.est_point - pair.true_point).squaredNorm();
  }
  PointScore score;
  score.rmse = root_mean_square(raw, points.size());
  if (const std::optional<seif::Pose2> T_true_est = align(est_points, true_points)) {
    double aligned = 0.0;
    for (const PointPair& pair : points)
      aligned += (*T_true_est * pair.est_point - pair.true_point).squaredNorm();
    score.rmse_aligned = root_mean_square(aligned, points.size());
  }
  return score;
}

PointScore absolute_trajectory_error(std::span<const PosePair> poses) {
  std::vector<PointPair> points;
  for (const PosePair& pair : poses)
    points.push_back({{pair.est_pose.x, pair.est_pose.y}, {pair.true_pose.x, pair.true_pose.y}});
  return score_points(points);
}

std::vector<std::pair<std::size_t, std::size_t>> pairs_apart(std::span<const double> values, double apart) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double wanted = values[i] + apart;
    const auto after = std::ranges::lower_bound(values, wanted);
    // If several of the smaller values are equal to the largest of them, take the first.
    const auto before = std::lower_bound(values.begin(), after, after == values.begin() ? wanted : after[-1]);
    const auto miss = [&](auto value) { return std::abs(*value - wanted); };
    const bool is_before = after == values.end() || (before != after && miss(before) <= miss(after));
    const auto nearest = is_before ? before : after;
    const auto j = static_cast<std::size_t>(nearest - values.begin());
    if (j > i && miss(nearest) <= 0.1 * apart) pairs.emplace_back(i, j);
  }
  return pairs;
}

RelativePoseError relative_pose_error(std::span<const PosePair> poses, double interval) {
  std::vector<double> times;
  for (const PosePair& pair : poses) times.push_back(pair.t);
  return error_of_motions(poses, pairs_apart(times, interval));
}

RelativePoseError relative_pose_error_along_path(std::span<const PosePair> poses, double distance) {
  std::vector<double> path(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const seif::Pose2& from = poses[i - 1].true_pose;
    const seif::Pose2& to = poses[i].true_pose;
    path[i] = path[i - 1] + std::hypot(to.x - from.x, to.y - from.y);
  }
  return error_of_motions(poses, pairs_apart(path, distance));
}

std::optional<double> rmse_from_robot(std::span<const PointPair> points, const PosePair& pose) {
  if (points.empty()) return std::nullopt;
  const seif::Pose2 T_est_robot_world = inverse(pose.est_pose);
  const seif::Pose2 T_true_robot_world = inverse(pose.true_pose);
  double sum = 0.0;
  for (const PointPair& pair : points)
    sum += (T_est_robot_world * pair.est_point - T_true_robot_world * pair.true_point).squaredNorm();
  return root_mean_square(sum, points.size());
}

std::optional<double> nees(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance) {
  return nees_per_dof(error, covariance);
}

std::optional<double> nees(const Eigen::Vector2d& error, const Eigen::Matrix2d& covariance) {
  return nees_per_dof(error, covariance);
}

std::optional<double> nees(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
  return nees_per_dof(error, covariance);
}

Eigen::Vector3d pose_error(const seif::Pose2& est_pose, const seif::Pose2& true_pose) {
  return {est_pose.x - true_pose.x, est_pose.y - true_pose.y,
          seif::wrap_angle(est_pose.theta - true_pose.theta)};
}

std::optional<Percentiles> percentiles(std::span<double> values) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  const auto rank = [&](std::size_t percent) { return values[(percent * values.size() + 99) / 100 - 1]; };
  return Percentiles{rank(50), rank(95), rank(99), values.back()};
}

std::vector<std::size_t> spread_sample(std::size_t count, std::size_t most) {
  const std::size_t size = std::min(count, most);
  std::vector<std::size_t> sample(size);
  for (std::size_t i = 0; i < size; ++i) sample[i] = i * count / size;
  return sample;
}

}  // namespace harness
