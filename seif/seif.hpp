// Our sparse extended information filter: constant time, and as accurate and as consistent as the dense ones.
#pragma once

#include <utility>
#include <vector>

#include "seif/association/associable_filter.hpp"
#include "seif/estimator.hpp"
#include "seif/groups/multilevel_mean.hpp"
#include "seif/information_state.hpp"
#include "seif/observation_factor.hpp"
#include "seif/tree/condensation_tree.hpp"

namespace seif {

/// Where Seif gets its mean from.
enum class SeifMean {
  tree,        // CondensationTree: exact in corridors, nearly so where large areas are covered
  multilevel,  // rigid groups of landmarks, MultilevelMean: on its way to the exact mean, in least memory
  exact        // sparse Cholesky: exact, not in constant time
};

struct SeifOptions {
  int theta_x = 6;     // [-] landmarks that keep their link to the robot after a sparsification
  int theta_max = 16;  // [-] sparsify only when the robot has more links than this
  /// [-] A landmark's first estimate is that after so many scans that saw it, or earlier, once it has a link
  /// to a passive one (InformationState::use_first_estimates). 0: none.
  int first_estimates = 5;
  /// [sigma] Nonlinearity of an observation above which it is linearised again, where the update has moved
  /// the mean to.
  double relinearise_above = 0.1;
  /// [-] An observation is linearised at what was measured where that lies farther from where the landmark is
  /// believed to be than so many times the measured range: the direction to it is useless then.
  /// As on a long ring that closes. 0: never.
  double closing_gate = 0.5;
  /// [-] An observation of a known landmark is left out if its innovation v has v' S^-1 v above this; 0:
  /// never. Needs mean_recovery tree, whose window knows its covariance in constant time.
  double gate = 0.0;
  /// [sigma] An observation of a known landmark whose innovation has sqrt(v' S^-1 v) above this gets a larger
  /// covariance, by how many times it is above it, which is Huber's weight; 0: never. Needs the same.
  double robust_above = 0.0;
  SeifMean mean_recovery = SeifMean::tree;
  MultilevelOptions multilevel = {};
  CondensationOptions tree = {};
};

/// What it does otherwise than the report's filter:
/// - keeps r = xi - Omega mu, so that a step of the mean is exact (information_state);
/// - solves for robot and active landmarks after the observations, and places new landmarks from there;
/// - takes the null space of its Jacobians from first estimates, so that it does not learn what nothing
///   observes;
/// - sparsifies by the gauge-free rule, in bursts, and never what is in view (sparsification);
/// - condenses all that is not near the robot along a tree (condensation_tree), or moves groups of landmarks
/// of
///   every size, each update a few (multilevel_mean).
class Seif final : public AssociableFilter {
 public:
  /// Throws std::invalid_argument if the start covariance is not positive definite, and for a gate without
  /// the tree.
  Seif(const EstimatorSetup& setup, const SeifOptions& options);

  void motion_update(const Odometry& odometry) override;
  void measurement_update(const Scan& scan, const StageDone& done) override;
  Pose2 pose() const override { return state_.pose(); }
  Counts counts() const override;
  std::size_t memory_bytes() const override;
  void landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const override;
  BeliefMatrix belief_matrix() const override { return BeliefMatrix::information; }
  void couplings(LandmarkId of, std::vector<Coupling>& out) const override;
  Eigen::MatrixXd whole_belief_matrix() const override;
  std::vector<LandmarkEstimate> map() const override;
  std::optional<MarginalCovariances> marginal_covariances(
      std::span<const LandmarkId> landmarks) const override;
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const LandmarkIds> groups) const override;

  // Need mean_recovery tree, as the gate does. At hand is what stands in the zone.
  void begin_association(double t) override { solve_window(t); }
  void landmarks_at_hand(std::vector<LandmarkId>& out) const override;
  bool is_at_hand(LandmarkId landmark) const override;
  Eigen::Vector2d mean_of(LandmarkId landmark) const override;
  ExpectedObservation expect(LandmarkId landmark, const Observation& observation) const override;
  void covariance_with(std::span<const LandmarkId> landmarks, Eigen::Ref<Eigen::MatrixXd> out) const override;
  bool keeps_start_uncertainty() const override { return state_.uses_first_estimates(); }
  void want(std::span<const LandmarkId> landmarks) override;
  void equate(LandmarkId a, LandmarkId b) override;

  const InformationState& state() const { return state_; }
  const CondensationTree& tree() const { return tree_; }

 private:
  Eigen::Vector2d mean(int slot) const;
  void activate_known(const Scan& scan);
  void add_equal(double t);
  void add_known(const Scan& scan);
  void check_innovations(double t);
  void note_innovation();
  double squared_mahalanobis(const ObservationFactor& factor);
  bool is_closing(int slot, const Observation& observation) const;
  [[nodiscard]] bool add_new(const Scan& scan);
  void relinearise(double t);
  void solve_window(double t);
  void sparsify(double t);
  void recover_mean(double t);

  SeifOptions options_;
  InformationState state_;
  MultilevelMean mean_;
  CondensationTree tree_;
  const bool by_tree_;  // whether the mean is the tree's
  Pose2 T_robot_sensor_;
  double anchoring_ = 0.0;  // [nat]
  std::int64_t gated_ = 0, weakened_ = 0;
  double innovation_ = 0.0;                               // [-] v' S^-1 v of the latest scan
  int innovation_degrees_ = 0;                            // [-]
  Eigen::Matrix<double, Eigen::Dynamic, 2> J_by_factor_;  // scratch (w x 2), with room to grow
  std::vector<ObservationFactor> factors_;                // of the latest scan
  std::vector<int> seen_, to_drop_;                       // slots; kept so that no update allocates
  std::vector<std::pair<int, int>> equal_;                // slots
  mutable std::vector<int> asked_;                        // slots
};

}  // namespace seif
