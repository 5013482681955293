// Our sparse extended information filter: as accurate and as consistent as the dense filters on the worlds of
// the gallery. The work of its median update does not grow with the map; docs/stress.md describes the slowest
// updates and the memory.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "seif/association/local_belief.hpp"
#include "seif/freezing.hpp"
#include "seif/groups/multilevel_mean.hpp"
#include "seif/information_filter.hpp"
#include "seif/mean_keeper.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/observation_factor.hpp"
#include "seif/start_frame.hpp"
#include "seif/team/tree_news.hpp"
#include "seif/tree/condensation_tree.hpp"
#include "seif/tree/tree_belief.hpp"

namespace seif {

struct SeifOptions {
  int theta_x = 6;     // [-] landmarks that keep their link to the robot after a sparsification
  int theta_max = 16;  // [-] sparsify only when the robot has more links than this
  /// [-] A landmark's first estimate settles after this number of scans that saw it, or earlier, when the
  /// landmark gets a link to a passive one (FirstEstimates). 0: no first estimates.
  int first_estimates = 5;
  /// [sigma] An observation with a larger nonlinearity is linearised again at the updated mean.
  double relinearise_above = 0.1;
  /// [-] Second-order terms of an observation count as noise, with this number of times their standard
  /// deviation (linearisation_noise). More than 1, because they are the same at each sighting until the mean
  /// moves. 0: not at all. Has an effect with MeanRecovery::tree only, which knows the covariance of the window.
  double linearisation_noise = 2.0;
  /// [-] An observation is linearised at the measurement if the landmark is seen farther from its mean than
  /// this number of times the measured range. Then the direction to the mean is useless, as when a long ring
  /// closes. 0: never.
  double closing_gate = 0.5;
  /// [-] Observations of a known landmark with v' S^-1 v above this are ignored. 0: none are. Needs
  /// MeanRecovery::tree, which knows the covariance of the window in bounded work.
  double gate = 0.0;
  /// [sigma] The covariance of an observation with sqrt(v' S^-1 v) above this is multiplied by the ratio of the
  /// two: Huber's weight. 0: never. Needs MeanRecovery::tree, too.
  double robust_above = 0.0;
  MeanRecovery mean_recovery = MeanRecovery::tree;  // tree, multilevel or exact
  MultilevelOptions multilevel = {};
  CondensationOptions tree = {};
};

/// It differs from the report's filter in seven points:
/// - It keeps r = xi - Omega mu, so that a step of the mean is exact (information_state).
/// - It solves for robot and active landmarks after the observations, and places new landmarks from the
///   corrected pose.
/// - It takes the null space of its Jacobians from first estimates, so that it does not learn what nothing
///   observes.
/// - It estimates in the frame of its start, and adds the uncertainty of the start to its covariances
///   (start_frame).
/// - It counts what an observation lacks in linearity as noise.
/// - It sparsifies by the gauge-free rule, in bursts, and never drops a landmark in view (sparsification).
/// - It recovers the mean with a condensation tree (tree/), or with rigid groups of landmarks (groups/).
class Seif final : public InformationFilter {
 public:
  /// Throws std::invalid_argument if the start covariance is not positive definite, for a gate without the
  /// tree, and for MeanRecovery::coordinate_descent.
  Seif(const EstimatorSetup& setup, const SeifOptions& options);
  Seif(const Seif&) = delete;  // its local belief refers to its state
  Seif& operator=(const Seif&) = delete;

  void motion_update(const Odometry& odometry) override;
  void measurement_update(const Scan& scan, const StageDone& done) override;
  /// With MeanRecovery::tree, from a scan to the next motion: what the tree's last solution gives.
  std::optional<Eigen::Matrix3d> pose_covariance() const override;
  Eigen::MatrixXd whole_belief_matrix() const override;
  std::optional<MarginalCovariances> marginal_covariances(
      std::span<const LandmarkId> landmarks) const override;
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const LandmarkIds> groups) const override;
  Counts counts() const override;
  std::size_t memory_bytes() const override;
  /// theta_x and theta_max; with MeanRecovery::tree also gate and robust_above.
  bool change_option(std::string_view option, double value) override;
  /// With MeanRecovery::tree; null otherwise.
  LocalBelief* local_belief() override { return belief_.get(); }
  /// The same: what others have told.
  TreeNews* news() { return news_.get(); }
  /// From now on calls `tell` with all that is frozen.
  void tell_frozen_to(std::function<void(const FrozenPiece&)> tell) { tell_ = std::move(tell); }

 protected:
  Eigen::Vector2d mean(int slot) const override { return keeper_->mean(state_, slot); }

 private:
  void make_keeper(const Pose2& start);
  Eigen::SparseMatrix<double> whole_information() const;
  void activate_known(const Scan& scan);
  void join_equal(double t);
  void relocate(double t);
  void forget_pose(const Surroundings& surroundings, double t);
  void allow_for_curvature(const Scan& scan);
  double noise_factor() const;
  double heading_variance(double t);
  Eigen::Vector2d noise_of(const ObservationFactor& factor);
  void check_innovations(double t);
  double squared_mahalanobis(const ObservationFactor& factor, const WindowFactor& window);
  void note_innovation();
  void carry_closing(double t);
  void relinearise(double t);
  bool any_stale();
  [[nodiscard]] bool add_new(const Scan& scan);
  void solve_window(double t);
  void sparsify(double t);
  [[nodiscard]] bool freeze_dropped();

  SeifOptions options_;
  StartFrame start_;
  std::unique_ptr<MeanKeeper> keeper_;
  CondensationTree* tree_ = nullptr;  // of the keeper, if it has one
  AskedOfFilter asked_;               // by belief_
  std::unique_ptr<LocalBelief> belief_;
  std::unique_ptr<TreeNews> news_;
  std::function<void(const FrozenPiece&)> tell_;
  double anchoring_ = 0.0;  // [nat]
  std::int64_t gated_ = 0, weakened_ = 0, relocations_ = 0;
  std::optional<double> innovation_;                      // [-] v' S^-1 v of the latest scan
  int innovation_degrees_ = 0;                            // [-]
  bool factor_is_current_ = false;                        // of the window: nothing has moved since the scan
  Eigen::Matrix<double, Eigen::Dynamic, 2> J_by_factor_;  // scratch (w x 2), with room to grow
  mutable Eigen::Matrix<double, Eigen::Dynamic, 3> columns_;  // scratch (w x 3), with room to grow
  bool is_curved_ = false;                                    // second-order terms matter in the latest scan
  std::vector<ObservationFactor> factors_, again_;            // of the latest scan
  FrozenPiece frozen_;                                        // by the latest sparsification
  std::vector<int> seen_, to_drop_;                           // slots; kept so that no update allocates
};

}  // namespace seif
