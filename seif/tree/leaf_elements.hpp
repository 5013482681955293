// Puts what is frozen into the elements of leaves.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "seif/freezing.hpp"
#include "seif/tree/condensation_records.hpp"
#include "seif/tree/front.hpp"
#include "seif/tree/hot_zone.hpp"
#include "seif/tree/leaf_element.hpp"

namespace seif {

class LeafElements {
 public:
  LeafElements(CondensationRecords& records, ArrayPool& pool) : records_(records), pool_(pool) {}

  /// A piece of hot landmarks, to the element of one of their leaves. That turns to where its landmarks in the zone are.
  void add(const FrozenPiece& piece, const HotZone& zone);

  /// A piece of any landmarks. `mean_of(slot)` is where one is. Returns the leaf whose element has got it, or none.
  template <class MeanOf>
  int add_anywhere(const FrozenPiece& piece, MeanOf&& mean_of) {
    if (piece.members.empty()) return none;
    const int owner = owner_of(piece);
    Condensed& element = records_.node(owner).own;
    begin_motion(element);
    for (const Condensed::Member& m : element.boundary) note_motion(m.variable, mean_of(m.variable));
    mover_.turn(boundary_.fit(), element);
    put(piece, owner);
    return owner;
  }

  std::int64_t blocks_touched() const { return blocks_touched_; }

 private:
  static constexpr int none = -1;
  int owner_of(const FrozenPiece& piece);
  void put(const FrozenPiece& piece, int owner);
  BodyMotion motion_in(const HotZone& zone, const Condensed& element);
  void begin_motion(const Condensed& element);
  void note_motion(int slot, const Eigen::Vector2d& now);
  void mention(int slot, const Eigen::Vector2d& reference, int owner);

  CondensationRecords& records_;
  ArrayPool& pool_;
  ElementMover mover_;
  MovedBoundary boundary_;
  const double* next_reference_ = nullptr;  // of the element whose motion is being noted
  int visit_ = 0;
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
