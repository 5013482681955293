// The report's SEIF in constant time: motion update, measurement update, sparsification, amortised mean
// recovery.
#pragma once

#include <random>
#include <vector>

#include "seif/estimator.hpp"
#include "seif/information_state.hpp"
#include "seif/registry.hpp"
#include "seif/sparsification.hpp"

namespace seif {

struct SeifReportOptions {
  int theta_x = 6;                                  // [-] landmarks that keep their link to the robot
  DropOrder drop = DropOrder::weakest_out_of_view;  // which of the active landmarks go first
  int random_landmarks = 10;                        // [-] K, relaxed in each update beside the active ones
};

/// Thrun, Koller, Ghahramani, Durrant-Whyte, Ng, "Simultaneous Mapping and Localization With Sparse Extended
/// Information Filters", 2002. As the report has it but for the slips that motion_update.hpp names. theta_y
/// is not enforced: the report gives no rule for it. Overconfident by its sparsification rule; that is a
/// finding, not a bug.
class SeifReport final : public Estimator {
 public:
  SeifReport(const EstimatorSetup& setup, const SeifReportOptions& options);

  void motion_update(const Odometry& odometry) override;
  void measurement_update(const Scan& scan, const StageDone& done) override;
  Pose2 pose() const override { return state_.pose(); }
  Counts counts() const override;
  std::size_t memory_bytes() const override { return state_.memory_bytes(); }
  std::vector<LandmarkEstimate> map() const override;
  std::optional<MarginalCovariances> marginal_covariances(
      std::span<const LandmarkId> landmarks) const override;

 private:
  InformationState state_;
  SeifReportOptions options_;
  Pose2 T_robot_sensor_;
  std::mt19937_64 random_;
  std::vector<int> to_deactivate_;  // slots; kept so that no update allocates
};

/// The registered type `seif_report`.
EstimatorType seif_report_type();

}  // namespace seif
