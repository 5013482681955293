// The dense extended information filter: exact up to linearisation; the reference for the sparse filters.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seif/estimator.hpp"
#include "seif/landmark_index.hpp"

namespace seif {

/// Eqs. (33), (21), (22), with the mean recovered exactly by a dense Cholesky factorisation after each scan,
/// eq. (10). O(N^3) for each update.
class Eif final : public Estimator {
 public:
  /// Throws std::invalid_argument if the start covariance is not positive definite.
  explicit Eif(const EstimatorSetup& setup);

  void motion_update(const Odometry& odometry) override;
  void measurement_update(const Scan& scan, const StageDone& done) override;
  Pose2 pose() const override { return {mu_(0), mu_(1), mu_(2)}; }
  Counts counts() const override;
  std::size_t memory_bytes() const override;
  void landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const override;
  BeliefMatrix belief_matrix() const override { return BeliefMatrix::information; }
  void couplings(LandmarkId of, std::vector<Coupling>& out) const override;
  Eigen::MatrixXd whole_belief_matrix() const override { return Omega_.selfadjointView<Eigen::Lower>(); }
  std::vector<LandmarkEstimate> map() const override;
  std::optional<MarginalCovariances> marginal_covariances(
      std::span<const LandmarkId> landmarks) const override;
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const LandmarkIds> groups) const override;

  /// The whole belief, for tests: (3+2N x 3+2N) and (3+2N x 1), landmarks in the order in which they
  /// joined.
  const Eigen::MatrixXd& Omega() const { return Omega_; }
  const Eigen::VectorXd& mu() const { return mu_; }

 private:
  std::optional<Eigen::MatrixXd> Sigma() const;  // nothing: Omega is not positive definite
  static int row_of(int slot) { return 3 + 2 * slot; }
  int row_of_landmark(const Observation& observation);

  Eigen::MatrixXd Omega_;
  Eigen::VectorXd mu_;  // exact between updates, so that xi = Omega mu and need not be kept
  std::vector<LandmarkId> ids_;
  LandmarkIndex index_;
  Pose2 T_robot_sensor_;
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
