// A filter around another one: passes on what it does not do itself.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "seif/association/local_belief.hpp"
#include "seif/estimator.hpp"

namespace seif {

class FilterAround : public Estimator {
 public:
  void motion_update(const Odometry& odometry) override { filter_->motion_update(odometry); }
  void measurement_update(const Scan& scan, const StageDone& done) override {
    filter_->measurement_update(scan, done);
  }
  bool needs_names() const override { return filter_->needs_names(); }
  std::span<const LandmarkId> associations() const override { return filter_->associations(); }
  LocalBelief* local_belief() override { return filter_->local_belief(); }
  Pose2 pose() const override { return filter_->pose(); }
  std::optional<Eigen::Matrix3d> pose_covariance() const override { return filter_->pose_covariance(); }
  Counts counts() const override { return filter_->counts(); }
  std::size_t memory_bytes() const override { return filter_->memory_bytes(); }
  void landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const override {
    filter_->landmarks(landmarks, out);
  }
  BeliefMatrix belief_matrix() const override { return filter_->belief_matrix(); }
  void couplings(LandmarkId of, std::vector<Coupling>& out) const override { filter_->couplings(of, out); }
  Eigen::MatrixXd whole_belief_matrix() const override { return filter_->whole_belief_matrix(); }
  std::vector<LandmarkEstimate> map() const override { return filter_->map(); }
  std::optional<MarginalCovariances> marginal_covariances(
      std::span<const LandmarkId> landmarks) const override {
    return filter_->marginal_covariances(landmarks);
  }
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const LandmarkIds> groups) const override {
    return filter_->joint_covariances(groups);
  }
  bool change_option(std::string_view option, double value) override {
    return filter_->change_option(option, value);
  }

 protected:
  explicit FilterAround(std::unique_ptr<Estimator> filter) : filter_(std::move(filter)) {}

  /// Throws std::invalid_argument, naming the option that needs it, if the filter has no local belief.
  LocalBelief& belief_for(const std::string& option) {
    if (LocalBelief* belief = filter_->local_belief()) return *belief;
    throw std::invalid_argument(option +
                                " needs a filter with a local belief: ekf, or seif with mean_recovery: tree");
  }

  std::unique_ptr<Estimator> filter_;
};

}  // namespace seif
