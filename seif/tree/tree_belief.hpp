// The belief over the landmarks of the tree's zone, for data association.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "seif/association/local_belief.hpp"
#include "seif/information_state.hpp"
#include "seif/tree/condensation_tree.hpp"

namespace seif {

/// What the filter does with the next scan.
struct AskedOfFilter {
  std::vector<std::pair<int, int>> equal_slots;  // pairs that are one landmark
  std::optional<Relocation> relocation;
};

/// The landmarks of the zone are at hand. Holds references to parts of the filter that owns it.
class TreeBelief final : public LocalBelief {
 public:
  /// `asked` collects what equate() and relocate() ask of the filter.
  TreeBelief(InformationState& state, CondensationTree& tree, const Pose2& T_robot_sensor,
             AskedOfFilter& asked)
      : state_(state), tree_(tree), T_robot_sensor_(T_robot_sensor), asked_of_filter_(asked) {}

  void begin_association(double t) override;
  void landmarks_at_hand(std::vector<LandmarkId>& out) const override;
  bool is_at_hand(LandmarkId landmark) const override;
  Eigen::Vector2d mean_of(LandmarkId landmark) const override;
  ExpectedObservation expect(LandmarkId landmark, const Observation& observation) const override;
  void covariance_with(std::span<const LandmarkId> landmarks, Eigen::Ref<Eigen::MatrixXd> out) const override;
  void want(std::span<const LandmarkId> landmarks) override;
  void equate(LandmarkId a, LandmarkId b) override;
  [[nodiscard]] bool bring(std::span<const LandmarkId> landmarks) override;
  void relocate(const Relocation& relocation) override { asked_of_filter_.relocation = relocation; }

 private:
  int slot_of(LandmarkId landmark) const { return state_.find(landmark).value(); }

  InformationState& state_;
  CondensationTree& tree_;
  const Pose2 T_robot_sensor_;
  AskedOfFilter& asked_of_filter_;
  mutable std::vector<int> asked_;  // slots; kept so that no update allocates
};

}  // namespace seif
