// The part of the Estimator interface that all filters on an InformationState share.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "seif/estimator.hpp"
#include "seif/information_state.hpp"

namespace seif {

/// A filter whose belief is an InformationState. Derived classes take in the scans.
class InformationFilter : public Estimator {
 public:
  void motion_update(const Odometry& odometry) override;
  Pose2 pose() const override { return state_.pose(); }
  std::size_t memory_bytes() const override { return state_.memory_bytes(); }
  void landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const override;
  std::vector<LandmarkEstimate> map() const override;
  BeliefMatrix belief_matrix() const override { return BeliefMatrix::information; }
  void couplings(LandmarkId of, std::vector<Coupling>& out) const override;
  Eigen::MatrixXd whole_belief_matrix() const override;
  std::optional<MarginalCovariances> marginal_covariances(
      std::span<const LandmarkId> landmarks) const override;
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const LandmarkIds> groups) const override;

  const InformationState& state() const { return state_; }

 protected:
  /// Throws std::invalid_argument if the start covariance is not positive definite.
  explicit InformationFilter(const EstimatorSetup& setup);

  /// p_world_landmark [m]. A filter that updates means only when they are read overrides it.
  virtual Eigen::Vector2d mean(int slot) const { return state_.mean(slot); }

  InformationState state_;
  const Pose2 T_robot_sensor_;
};

}  // namespace seif
