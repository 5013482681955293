#include "seif/information_filter.hpp"

#include "seif/couplings.hpp"
#include "seif/full_state.hpp"
#include "seif/marginals.hpp"
#include "seif/motion_update.hpp"
#include "seif/start_points.hpp"

namespace seif {

InformationFilter::InformationFilter(const EstimatorSetup& setup)
    : state_(setup.start), T_robot_sensor_(setup.T_robot_sensor) {}

void InformationFilter::motion_update(const Odometry& odometry) { seif::motion_update(state_, odometry); }

void InformationFilter::landmarks(std::span<const LandmarkId> landmarks,
                                  std::vector<LandmarkEstimate>& out) const {
  out.clear();
  for (const LandmarkId landmark : landmarks) {
    if (const auto slot = state_.find(landmark)) out.push_back({landmark, mean(*slot)});
  }
}

std::vector<LandmarkEstimate> InformationFilter::map() const {
  std::vector<LandmarkEstimate> map;
  map.reserve(static_cast<std::size_t>(state_.landmark_count()));
  for (int slot = 0; slot < state_.landmark_count(); ++slot) {
    if (!is_start_point(state_.id(slot))) map.push_back({state_.id(slot), mean(slot)});
  }
  return map;
}

void InformationFilter::couplings(LandmarkId of, std::vector<Coupling>& out) const {
  couplings_of(state_, of, out);
}

Eigen::MatrixXd InformationFilter::whole_belief_matrix() const {
  const Eigen::MatrixXd lower = full_Omega(state_);
  return lower.selfadjointView<Eigen::Lower>();
}

std::optional<MarginalCovariances> InformationFilter::marginal_covariances(
    std::span<const LandmarkId> landmarks) const {
  return marginals_of(state_, landmarks);
}

std::optional<std::vector<Eigen::MatrixXd>> InformationFilter::joint_covariances(
    std::span<const LandmarkIds> groups) const {
  return joint_covariances_of(state_, groups);
}

}  // namespace seif
