#include "seif/report_seif.hpp"

#include <algorithm>
#include <vector>

#include "seif/couplings.hpp"
#include "seif/marginals.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/measurement_update.hpp"
#include "seif/motion_update.hpp"

namespace seif {

ReportSeif::ReportSeif(const EstimatorSetup& setup, const ReportSeifOptions& options)
    : state_(setup.start), options_(options), T_robot_sensor_(setup.T_robot_sensor), random_(setup.random) {
  state_.track_residual();
}

void ReportSeif::motion_update(const Odometry& odometry) { seif::motion_update(state_, odometry); }

void ReportSeif::measurement_update(const Scan& scan, const StageDone& done) {
  seif::measurement_update(state_, scan.observations, T_robot_sensor_);
  done(Stage::measurement);

  choose_surplus();
  if (!to_drop_.empty()) {
    const std::optional<double> anchoring = sparsify(state_, options_.rule, to_drop_);
    if (!anchoring) throw NumericalFailure("sparsification", scan.t);
    anchoring_ += *anchoring;
  }
  done(Stage::sparsification);

  const bool recovered = options_.mean_recovery == MeanRecovery::exact
                             ? solve_mean(state_)
                             : coordinate_descent(state_, options_.random_landmarks, random_);
  if (!recovered) throw NumericalFailure("mean recovery", scan.t);
  done(Stage::mean_recovery);
}

/// Fills to_drop_ with the active landmarks that are to lose their link to the robot now.
void ReportSeif::choose_surplus() {
  to_drop_.clear();
  if (state_.active_count() <= std::max(options_.theta_x, options_.theta_max)) return;
  choose_to_drop(state_, options_.drop, state_.active_count() - options_.theta_x, to_drop_);
  if (options_.keep_in_view) {
    std::erase_if(to_drop_, [this](int slot) { return state_.scans_since_seen(slot) == 0; });
  }
}

Counts ReportSeif::counts() const {
  return {.blocks_touched = state_.blocks_touched(),
          .active_landmarks = state_.active_count(),
          .links = state_.link_count(),
          .mean_residual = state_.squared_residual(),
          .anchoring = anchoring_};
}

void ReportSeif::landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const {
  landmarks_of(state_, landmarks, out);
}

void ReportSeif::couplings(LandmarkId of, std::vector<Coupling>& out) const { couplings_of(state_, of, out); }

Eigen::MatrixXd ReportSeif::whole_belief_matrix() const { return dense_Omega_of(state_); }

std::vector<LandmarkEstimate> ReportSeif::map() const { return map_of(state_); }

std::optional<MarginalCovariances> ReportSeif::marginal_covariances(
    std::span<const LandmarkId> landmarks) const {
  return marginals_of(state_, landmarks);
}

std::optional<std::vector<Eigen::MatrixXd>> ReportSeif::joint_covariances(
    std::span<const LandmarkIds> groups) const {
  return joint_covariances_of(state_, groups);
}

}  // namespace seif
