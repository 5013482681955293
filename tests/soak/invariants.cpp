#include "invariants.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

namespace soak {

namespace {

constexpr std::size_t most_told = 20;  // [-] messages of one run

bool is_finite(const seif::Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta);
}

template <class Matrix>
bool is_proper(const Matrix& covariance) {
  const double largest = covariance.cwiseAbs().maxCoeff();
  return covariance.allFinite() &&
         (covariance - covariance.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * largest &&
         covariance.llt().info() == Eigen::Success;
}

}  // namespace

void Invariants::require(bool holds, std::size_t estimator, double t, const char* what) {
  if (holds || broken_.size() >= most_told) return;
  broken_.push_back(fmt::format("{} at {} s: {}", believers_.estimators[estimator].name, t, what));
}

void Invariants::odometry(const harness::OdometryEvent& event) {
  require(is_finite(event.odometry.T_previous_current), 0, event.odometry.t, "odometry is not finite");
  require(event.odometry.t >= last_t_, 0, event.odometry.t, "time runs backwards");
  last_t_ = event.odometry.t;
}

void Invariants::scan(const harness::ScanEvent& event) {
  require(event.scan.t >= last_t_, 0, event.scan.t, "time runs backwards");
  last_t_ = event.scan.t;
  largest_scan_ = std::max(largest_scan_, event.scan.observations.size());
  observations_ += event.scan.observations.size();
}

void Invariants::update(std::size_t estimator, const harness::UpdateRecord& record) {
  const seif::Pose2& pose = record.est_pose;
  require(is_finite(pose), estimator, record.t, "the pose is not finite");
  require(std::abs(pose.theta) <= 3.1415926535897936, estimator, record.t, "the heading is not wrapped");
  if (record.est_covariance)
    require(is_proper(*record.est_covariance), estimator, record.t, "the pose's covariance is none");
  if (record.counts.innovation)
    require(std::isfinite(*record.counts.innovation) && *record.counts.innovation >= 0.0, estimator, record.t,
            "the innovation is no square");
  require(record.blocks_touched >= 0 && record.counts.links >= 0, estimator, record.t, "a count is negative");
  const std::string& name = believers_.estimators[estimator].name;
  if (name == "seif" || name == "groups") {  // theta_max, the landmarks in view, and the new ones of the scan
    constexpr int largest_theta_max = 24;
    require(record.counts.active_landmarks <= largest_theta_max + 2 * static_cast<int>(largest_scan_),
            estimator, record.t, "more landmarks are active than the filter allows");
  }
}

void Invariants::consistency(std::size_t estimator, const harness::ConsistencyRecord& record) {
  require(record.landmarks_mapped <= static_cast<int>(observations_), estimator, record.t,
          "more landmarks are mapped than were ever seen");
  require(record.nees_pose.value_or(0.0) >= 0.0, estimator, record.t, "a NEES is negative");
  require_proper_belief(estimator, record.t);
}

/// Only for our filters: the report's filter may lose its proper belief, and reports that.
void Invariants::require_proper_belief(std::size_t estimator, double t) {
  const harness::LiveEstimator& live = believers_.estimators[estimator];
  const std::vector<seif::LandmarkEstimate> map = live.filter->map();
  std::vector<seif::LandmarkId> ids;
  for (const seif::LandmarkEstimate& landmark : map) ids.push_back(landmark.landmark);
  const auto belief = live.filter->marginal_covariances(ids);
  if (!belief) return require(live.name == "seif_report", estimator, t, "the belief is no proper Gaussian");
  require(is_proper(belief->pose), estimator, t, "the pose's marginal is no covariance");
  require(std::ranges::all_of(belief->landmarks, [](const Eigen::Matrix2d& P) { return is_proper(P); }),
          estimator, t, "a landmark's marginal is no covariance");
  const Eigen::MatrixXd whole = live.filter->whole_belief_matrix();
  if (whole.size() > 0 && live.name != "seif_report")
    require(is_proper(whole), estimator, t, "the whole belief is not symmetric and positive definite");
}

void Invariants::map(std::size_t estimator, std::span<const harness::MapRecord> landmarks) {
  for (const harness::MapRecord& landmark : landmarks)
    require(landmark.mean.allFinite(), estimator, last_t_, "a landmark is not finite");
}

}  // namespace soak
