// The zone moves: the messages of a plan take the places of those before, and the zone begins anew with what has come
// to its ring and what was frozen since the plan began.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/tree/condensation_plan.hpp"
#include "seif/tree/condensation_records.hpp"
#include "seif/tree/hot_zone.hpp"
#include "seif/tree/moved_part.hpp"

namespace seif {

/// Landmarks at known places, in the zone for ever.
struct HeldLandmarks {
  std::vector<int> slots;
  std::vector<Eigen::Vector2d> at;  // p_world [m]
  double weight = 0.0;              // [1/m^2]
  /// What the zone knows of them besides, before any landmark is eliminated (2n x 2n). Kept here, because `weight` is so
  /// large that the zone's own numbers lose it to rounding.
  Eigen::MatrixXd Omega;
};

class ZoneSwitch {
 public:
  ZoneSwitch(CondensationRecords& records, CondensationPlan& plan, HeldLandmarks& held, HotZone& zone)
      : records_(records), plan_(plan), held_(held), zone_(zone) {}

  /// `read` of the landmarks in the zone must be their means now. Elements get nothing yet. False if a matrix is not
  /// positive definite.
  [[nodiscard]] bool move(InformationState& state);
  /// The same zone, linearised anew at `read` of its landmarks, which must be their means now; and the window with it.
  /// False if a matrix is not positive definite.
  [[nodiscard]] bool carry(InformationState& state);
  /// Blocks that the next one will touch. [-]
  std::int64_t expected_blocks() const;

  /// Adds a piece whose members are in the zone.
  void add_to_zone(const FrozenPiece& piece);
  /// Adds what is known of the held landmarks.
  void anchor_zone();

  std::int64_t blocks_touched() const { return blocks_touched_; }

 private:
  static constexpr int none = -1;
  void bring_incoming();
  void switch_leaves();
  void replace(int at);
  void forget(SentMessage& sent);
  void settle(FrontVariable v, int at);
  void load();
  template <class PlaceBefore>
  void bring_zone(PlaceBefore&& place_before);
  void release_held();
  int held_index(std::size_t i) const { return records_.landmark(held_.slots[i]).zone_index; }
  auto held_block(std::size_t i, std::size_t j) {
    return held_.Omega.block<2, 2>(static_cast<Eigen::Index>(2 * i), static_cast<Eigen::Index>(2 * j));
  }
  void add_to_held(int slot, int other, const Eigen::Matrix2d& Omega);
  void balance_held();
  void add_rest();
  void bring_to_zone(const FrozenPiece& piece);
  void carry_window(InformationState& state);
  void list_inactive(const InformationState& state);
  [[nodiscard]] bool eliminate_inactive(const InformationState& state);

  CondensationRecords& records_;
  CondensationPlan& plan_;
  HeldLandmarks& held_;
  HotZone& zone_;
  MovedBoundary boundary_;
  std::vector<MovedPlace> places_;
  std::vector<int> inactive_;
  FrozenPiece piece_;
  Eigen::VectorXd square_;  // of a piece (2m x 2m), with room to grow
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
