// Puts what is frozen into the elements of leaves.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "seif/freezing.hpp"
#include "seif/tree/condensation_records.hpp"
#include "seif/tree/front.hpp"
#include "seif/tree/leaf_element.hpp"

namespace seif {

class LeafElements {
 public:
  LeafElements(CondensationRecords& records, ArrayPool& pool) : records_(records), pool_(pool) {}

  /// A piece, to the element of the leaf of one of its landmarks. That turns to where its own landmarks are, by
  /// `place_of(slot)`: p_world, if it is at hand. [m]
  template <class PlaceOf>
  void add(const FrozenPiece& piece, PlaceOf&& place_of) {
    if (piece.members.empty()) return;
    const int owner = owner_of(piece);
    Condensed& element = records_.node(owner).own;
    boundary_.begin(records_.turning());
    const double* reference = element.reference.data();
    for (const Condensed::Member& m : element.boundary) {
      if (const std::optional<Eigen::Vector2d> now = place_of(m.variable))
        boundary_.add(records_.moved_place(m.variable, reference, now->data()));
      reference += 2;
    }
    mover_.turn(boundary_.fit(), element);
    put(piece, owner);
  }

  std::int64_t blocks_touched() const { return blocks_touched_; }

 private:
  static constexpr int none = -1;
  int owner_of(const FrozenPiece& piece);
  void put(const FrozenPiece& piece, int owner);
  void mention(int slot, const Eigen::Vector2d& reference, int owner);

  CondensationRecords& records_;
  ArrayPool& pool_;
  ElementMover mover_;
  MovedBoundary boundary_;
  int visit_ = 0;
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
