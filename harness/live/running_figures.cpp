#include "harness/live/running_figures.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "harness/score/score.hpp"

namespace harness {

namespace {

constexpr double smallest_counted = 0.01;
constexpr double bin_ratio = 1.01;

double three_sigma_of(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance.topLeftCorner<2, 2>());
  return 3.0 * std::sqrt(std::max(0.0, eigen.eigenvalues()(1)));
}

}  // namespace

void QuantileCounts::add(double value) {
  if (!(value >= 0.0)) return;
  const double bin = std::log(std::max(value / smallest_counted, 1.0)) / std::log(bin_ratio);
  ++counts_[std::min(static_cast<std::size_t>(bin), bins - 1)];
  ++total_;
}

double QuantileCounts::quantile(double share) const {
  const auto wanted = static_cast<std::int64_t>(std::ceil(share * static_cast<double>(total_)));
  std::int64_t passed = 0;
  for (std::size_t i = 0; i < bins && total_ > 0; ++i) {
    passed += counts_[i];
    if (passed >= wanted) return smallest_counted * std::pow(bin_ratio, static_cast<double>(i) + 0.5);
  }
  return 0.0;
}

void RunningFigures::update(const UpdateRecord& record) {
  figures_.update_us = record.times.update;
  times_.add(record.times.update);
  figures_.links = record.counts.links;
  figures_.active = record.counts.active_landmarks;
  figures_.error.reset();
  figures_.three_sigma.reset();
  if (record.true_pose) {
    const Eigen::Vector3d error = pose_error(record.est_pose, *record.true_pose);
    figures_.error = error.head<2>().norm();
    squares_ += error.head<2>().squaredNorm();
    figures_.rmse = std::sqrt(squares_ / static_cast<double>(++errors_));
    if (record.est_covariance) figures_.nees = nees(error, *record.est_covariance);
  }
  if (record.est_covariance) figures_.three_sigma = three_sigma_of(*record.est_covariance);

  LiveChartPoint point{static_cast<float>(record.t), static_cast<float>(record.times.update)};
  if (figures_.error) point.error = static_cast<float>(*figures_.error);
  if (figures_.three_sigma) point.three_sigma = static_cast<float>(*figures_.three_sigma);
  if (figures_.nees) point.nees = static_cast<float>(*figures_.nees);
  if (points_.size() >= most_points) halve(points_);
  points_.push_back(point);
}

void RunningFigures::consistency(const ConsistencyRecord& record) {
  if (record.nees_pose) figures_.nees = record.nees_pose;
  figures_.nees_map = record.nees_landmark;
  figures_.memory_bytes = record.memory_bytes;
}

void RunningFigures::read_quantiles() {
  figures_.p50_us = times_.quantile(0.5);
  figures_.p99_us = times_.quantile(0.99);
}

void RunningFigures::hand_over(std::vector<LiveChartPoint>& points) {
  points.swap(points_);
  points_.clear();
}

}  // namespace harness
