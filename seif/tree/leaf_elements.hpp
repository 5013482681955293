// Puts what is frozen into the elements of leaves.
#pragma once

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

  std::int64_t blocks_touched() const { return blocks_touched_; }

 private:
  static constexpr int none = -1;
  int owner_of(const FrozenPiece& piece);
  BodyMotion motion_in(const HotZone& zone, const Condensed& element);
  void mention(int slot, const Eigen::Vector2d& reference, int owner);

  CondensationRecords& records_;
  ArrayPool& pool_;
  ElementMover mover_;
  MovedBoundary boundary_;
  int visit_ = 0;
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
