#include "seif/tree/tree_belief.hpp"

#include "seif/estimator.hpp"
#include "seif/observation_factor.hpp"
#include "seif/start_points.hpp"

namespace seif {

void TreeBelief::begin_association(double t) {
  if (!tree_.solve_window(state_)) throw NumericalFailure("local solve", t);
}

void TreeBelief::landmarks_at_hand(std::vector<LandmarkId>& out) const {
  out.clear();
  tree_.for_each_in_zone([&](int slot) {
    if (!is_start_point(state_.id(slot))) out.push_back(state_.id(slot));
  });
}

bool TreeBelief::is_at_hand(LandmarkId landmark) const {
  const auto slot = state_.find(landmark);
  return slot && tree_.is_in_zone(*slot);
}

Eigen::Vector2d TreeBelief::mean_of(LandmarkId landmark) const {
  return tree_.mean(state_, slot_of(landmark));
}

ExpectedObservation TreeBelief::expect(LandmarkId landmark, const Observation& observation) const {
  const ObservationFactor factor =
      linearise(state_, slot_of(landmark), mean_of(landmark), observation, T_robot_sensor_);
  return {factor.v, factor.J_x, factor.J_m};
}

void TreeBelief::covariance_with(std::span<const LandmarkId> landmarks,
                                 Eigen::Ref<Eigen::MatrixXd> out) const {
  asked_.clear();
  for (const LandmarkId landmark : landmarks) asked_.push_back(slot_of(landmark));
  tree_.covariance(state_, asked_, out);
}

void TreeBelief::want(std::span<const LandmarkId> landmarks) {
  for (const LandmarkId landmark : landmarks) tree_.want(slot_of(landmark));
}

void TreeBelief::equate(LandmarkId a, LandmarkId b) {
  asked_of_filter_.equal_slots.emplace_back(slot_of(a), slot_of(b));
}

bool TreeBelief::bring(std::span<const LandmarkId> landmarks) {
  asked_.clear();
  for (const LandmarkId landmark : landmarks) asked_.push_back(slot_of(landmark));
  return tree_.bring(state_, asked_) && tree_.solve_window(state_);
}

}  // namespace seif
