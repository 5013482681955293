// The dense EKF: the baseline.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "seif/association/local_belief.hpp"
#include "seif/dense/flat_prior.hpp"
#include "seif/dense/symmetric_downdate.hpp"
#include "seif/estimator.hpp"
#include "seif/landmark_index.hpp"

namespace seif {

struct EkfOptions {
  /// [-] Ignores an observation of a known landmark with v' S^-1 v above this. 0: never.
  double gate = 0.0;
  /// [sigma] Enlarges the covariance of an observation with sqrt(v' S^-1 v) above this, by the ratio of the two:
  /// Huber's weight. 0: never.
  double robust_above = 0.0;
};

/// Covariance form; all known landmarks of a scan in one update, on the lower triangle alone. O(N^2) for each
/// update.
class Ekf final : public Estimator, public LocalBelief {
 public:
  /// Throws std::invalid_argument if the start covariance is not positive definite.
  explicit Ekf(const EstimatorSetup& setup, const EkfOptions& options = {});

  void motion_update(const Odometry& odometry) override;
  void measurement_update(const Scan& scan, const StageDone& done) override;
  Pose2 pose() const override;
  std::optional<Eigen::Matrix3d> pose_covariance() const override;
  Counts counts() const override;
  std::size_t memory_bytes() const override;
  void landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const override;
  BeliefMatrix belief_matrix() const override { return BeliefMatrix::covariance; }
  void couplings(LandmarkId of, std::vector<Coupling>& out) const override;
  Eigen::MatrixXd whole_belief_matrix() const override { return Sigma(); }
  std::vector<LandmarkEstimate> map() const override;
  std::optional<MarginalCovariances> marginal_covariances(
      std::span<const LandmarkId> landmarks) const override;
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const LandmarkIds> groups) const override;

  /// gate and robust_above.
  bool change_option(std::string_view option, double value) override;

  LocalBelief* local_belief() override { return this; }
  void begin_association(double /*t*/) override {}
  void landmarks_at_hand(std::vector<LandmarkId>& out) const override { out = ids_; }
  bool is_at_hand(LandmarkId landmark) const override { return index_.find(landmark).has_value(); }
  Eigen::Vector2d mean_of(LandmarkId landmark) const override;
  ExpectedObservation expect(LandmarkId landmark, const Observation& observation) const override;
  void covariance_with(std::span<const LandmarkId> landmarks, Eigen::Ref<Eigen::MatrixXd> out) const override;
  void equate(LandmarkId a, LandmarkId b) override;
  void relocate(const Relocation& relocation) override { relocation_ = relocation; }

  /// The whole belief, for tests: (3+2N x 1) and (3+2N x 3+2N), landmarks in the order of their slots.
  Eigen::VectorXd mu() const { return mu_.head(size()); }
  Eigen::MatrixXd Sigma() const;

 private:
  /// An observation of a landmark in the map, linearised.
  struct Linearised {
    int row = 0;                    // of the landmark in the state
    Eigen::Vector2d v;              // innovation
    Eigen::Matrix<double, 2, 5> J;  // wrt [x y theta m_x m_y]
    Eigen::Matrix2d Q;              // noise
  };

  int landmark_count() const { return static_cast<int>(ids_.size()); }
  int size() const { return 3 + 2 * landmark_count(); }
  double squared_mahalanobis(const Linearised& linearised) const;
  bool admit(Linearised& linearised);
  static int row_of(int slot) { return 3 + 2 * slot; }
  void set_pose(const Pose2& pose);
  template <int Width>
  void gather_columns(int row, int to);
  [[nodiscard]] bool update_known();
  [[nodiscard]] bool apply_gain(int observed);
  [[nodiscard]] bool update_equal();
  [[nodiscard]] bool update_relocation();
  void apply(const FlatPriorUpdate& update, std::span<const int> flat);
  void append(LandmarkId landmark, const Eigen::Vector2d& mean);
  void add_landmark(const Observation& observation);
  void reserve(int landmarks);

  Eigen::VectorXd mu_;                                // with room to grow
  Eigen::MatrixXd Sigma_;                             // lower triangle, with room to grow
  Eigen::Matrix<double, Eigen::Dynamic, 5> columns_;  // scratch: the columns of Sigma for [x y theta m_x m_y]
  Eigen::MatrixXd W_;                                 // scratch (3+2N x 2k)
  Eigen::MatrixXd S_;                                 // scratch (2k x 2k)
  Eigen::VectorXd v_;                                 // scratch (2k x 1)
  SymmetricDowndate downdate_;
  std::vector<Linearised> known_;
  std::vector<std::pair<LandmarkId, LandmarkId>> equal_;
  std::optional<Relocation> relocation_;
  std::vector<const Observation*> pending_;
  std::vector<const Observation*> unknown_;
  std::vector<LandmarkId> ids_;  // by slot
  LandmarkIndex index_;
  Pose2 T_robot_sensor_;
  EkfOptions options_;
  std::int64_t gated_ = 0, weakened_ = 0, relocations_ = 0;
  double innovation_ = 0.0;     // [-] v' S^-1 v of the latest scan
  int innovation_degrees_ = 0;  // [-]
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
