// The belief over the landmarks of the tree's zone, for data association.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "seif/association/local_belief.hpp"
#include "seif/information_state.hpp"
#include "seif/tree/condensation_tree.hpp"

namespace seif {

/// The landmarks of the zone are at hand. Holds references to parts of the filter that owns it.
class TreeBelief final : public LocalBelief {
 public:
  /// `equal_slots` collects the pairs of equate() for the filter.
  TreeBelief(InformationState& state, CondensationTree& tree, const Pose2& T_robot_sensor,
             std::vector<std::pair<int, int>>& equal_slots)
      : state_(state), tree_(tree), T_robot_sensor_(T_robot_sensor), equal_slots_(equal_slots) {}

  void begin_association(double t) override;
  void landmarks_at_hand(std::vector<LandmarkId>& out) const override;
  bool is_at_hand(LandmarkId landmark) const override;
  Eigen::Vector2d mean_of(LandmarkId landmark) const override;
  ExpectedObservation expect(LandmarkId landmark, const Observation& observation) const override;
  void covariance_with(std::span<const LandmarkId> landmarks, Eigen::Ref<Eigen::MatrixXd> out) const override;
  void want(std::span<const LandmarkId> landmarks) override;
  void equate(LandmarkId a, LandmarkId b) override;

 private:
  int slot_of(LandmarkId landmark) const { return state_.find(landmark).value(); }

  InformationState& state_;
  CondensationTree& tree_;
  const Pose2 T_robot_sensor_;
  std::vector<std::pair<int, int>>& equal_slots_;
  mutable std::vector<int> asked_;  // slots; kept so that no update allocates
};

}  // namespace seif
