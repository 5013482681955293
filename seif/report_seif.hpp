// The sparse extended information filter: motion update, measurement update, sparsification, mean recovery.
#pragma once

#include <random>
#include <vector>

#include "seif/estimator.hpp"
#include "seif/information_state.hpp"
#include "seif/sparsification.hpp"

namespace seif {

enum class MeanRecovery {
  coordinate_descent,  // the report's, in constant time
  exact                // by sparse Cholesky: not in constant time
};

/// The defaults are the report's filter, in constant time.
struct ReportSeifOptions {
  int theta_x = 6;    // [-] landmarks that keep their link to the robot after a sparsification
  int theta_max = 0;  // [-] sparsify only when the robot has more links than this; at most theta_x: at once
  SparsificationRule rule = SparsificationRule::report;
  DropOrder drop = DropOrder::weakest_out_of_view;  // which of the active landmarks lose their link first
  bool keep_in_view = false;  // never drop a landmark of the latest scan, whatever the bounds say
  MeanRecovery mean_recovery = MeanRecovery::coordinate_descent;
  int random_landmarks = 10;  // [-] K of the coordinate descent, beside the active ones
};

/// Thrun, Koller, Ghahramani, Durrant-Whyte, Ng, "Simultaneous Mapping and Localization With Sparse Extended
/// Information Filters", 2002. As the report has it but for the slips that motion_update.hpp names. theta_y
/// is not enforced: the report gives no rule for it. With the report's rule it is overconfident; that is a
/// finding, not a bug.
///
/// The report drops the weakest links, and expects those to be of the landmarks seen longest ago. Where more
/// than theta_x landmarks are in view that does not follow: the first landmarks then keep the strongest links
/// for ever, and information grows exponentially with the distance from them. So the default drops those in
/// view last; DropOrder::weakest_link is to the letter.
class ReportSeif final : public Estimator {
 public:
  ReportSeif(const EstimatorSetup& setup, const ReportSeifOptions& options);

  void motion_update(const Odometry& odometry) override;
  void measurement_update(const Scan& scan, const StageDone& done) override;
  Pose2 pose() const override { return state_.pose(); }
  Counts counts() const override;
  std::size_t memory_bytes() const override { return state_.memory_bytes(); }
  void landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const override;
  BeliefMatrix belief_matrix() const override { return BeliefMatrix::information; }
  void couplings(LandmarkId of, std::vector<Coupling>& out) const override;
  Eigen::MatrixXd whole_belief_matrix() const override;
  std::vector<LandmarkEstimate> map() const override;
  std::optional<MarginalCovariances> marginal_covariances(
      std::span<const LandmarkId> landmarks) const override;
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const LandmarkIds> groups) const override;

  const InformationState& state() const { return state_; }

 private:
  void choose_surplus();

  InformationState state_;
  ReportSeifOptions options_;
  Pose2 T_robot_sensor_;
  std::mt19937_64 random_;
  double anchoring_ = 0.0;    // [nat]
  std::vector<int> to_drop_;  // slots; kept so that no update allocates
};

}  // namespace seif
