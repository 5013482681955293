#include "harness/paper/belief.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

namespace harness {

namespace {

std::runtime_error unfit(const LiveEstimator& estimator, std::string_view why) {
  return std::runtime_error(fmt::format("the belief of {} cannot be drawn: {}", estimator.name, why));
}

Eigen::MatrixXd inverse_of(const LiveEstimator& estimator, const Eigen::MatrixXd& M) {
  const Eigen::LLT<Eigen::MatrixXd> llt(M);
  if (llt.info() != Eigen::Success) throw unfit(estimator, "its matrix is not positive definite");
  return llt.solve(Eigen::MatrixXd::Identity(M.rows(), M.cols()));
}

/// Of a filter that keeps an information matrix. Not simply the inverse of that matrix: `seif` leaves the
/// uncertainty of the start out of it.
Eigen::MatrixXd covariance_of(const LiveEstimator& estimator) {
  seif::LandmarkIds all;
  for (const seif::LandmarkEstimate& estimate : estimator.filter->map()) all.push_back(estimate.landmark);
  const auto joint = estimator.filter->joint_covariances(std::array{all});
  if (!joint) throw unfit(estimator, "its matrix is not positive definite");
  return joint->front();
}

Eigen::Index row_of(int landmark) { return 3 + 2 * landmark; }

/// The block of the matrix between landmark `to` and `from`, the robot or a landmark.
auto block_of(const Eigen::MatrixXd& M, int from, int to) {
  return from == robot ? M.block(row_of(to), 0, 2, 3) : M.block(row_of(to), row_of(from), 2, 2);
}

}  // namespace

Belief belief_of(const LiveEstimator& estimator, std::span<const TrueLandmark> truth,
                 const seif::Pose2& true_pose) {
  if (!estimator.failure.empty()) throw unfit(estimator, "it failed " + estimator.failure);
  Belief belief;
  belief.estimator = estimator.name;
  belief.pose = {.t = 0.0, .est_pose = estimator.filter->pose(), .true_pose = true_pose};
  for (const seif::LandmarkEstimate& estimate : estimator.filter->map()) {
    const auto landmark = std::ranges::lower_bound(truth, estimate.landmark, {}, &TrueLandmark::landmark);
    if (landmark == truth.end() || landmark->landmark != estimate.landmark)
      throw unfit(estimator, "its map has a landmark that the world does not have");
    belief.landmarks.push_back({.est_point = estimate.mean, .true_point = landmark->position});
  }
  const Eigen::MatrixXd M = estimator.filter->whole_belief_matrix();
  if (M.size() == 0) throw unfit(estimator, "it keeps no matrix");
  const bool is_covariance = estimator.filter->belief_matrix() == seif::BeliefMatrix::covariance;
  belief.covariance = is_covariance ? M : covariance_of(estimator);
  belief.information = is_covariance ? inverse_of(estimator, M) : M;
  return belief;
}

Eigen::MatrixXd normalised(const Eigen::MatrixXd& M) {
  const Eigen::VectorXd scale = M.diagonal().cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * M * scale.asDiagonal()).cwiseAbs();
}

std::vector<NetworkLink> links_of(const Eigen::MatrixXd& normalised_information) {
  const int landmarks = static_cast<int>(normalised_information.rows() - 3) / 2;
  std::vector<NetworkLink> links;
  for (int to = 0; to < landmarks; ++to) {
    for (int from = robot; from < to; ++from) {
      const double strength = block_of(normalised_information, from, to).maxCoeff();
      if (strength > 0.0) links.push_back({from, to, strength});
    }
  }
  std::ranges::stable_sort(links, {}, &NetworkLink::strength);
  return links;
}

}  // namespace harness
