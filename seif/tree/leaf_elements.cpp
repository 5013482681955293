#include "seif/tree/leaf_elements.hpp"

namespace seif {

/// To an element that is turned to where its landmarks are.
void LeafElements::put(const FrozenPiece& piece, int owner) {
  Condensed& element = records_.node(owner).own;
  ++visit_;
  for (std::size_t i = 0; i < element.boundary.size(); ++i) {
    CondensedLandmark& p = records_.landmark(element.boundary[i].variable);
    p.visit = visit_;
    p.row = static_cast<int>(i);
  }
  for (const FrozenPiece::Member& m : piece.members) mention(m.slot, m.reference, owner);
  add_piece(
      piece, [&](int slot) { return records_.landmark(slot).row; }, pool_, element);
  blocks_touched_ += Condensed::blocks_of(piece.rows()) + element.boundary_blocks();
}

/// By the element of this leaf; a landmark that is new in the map by its own leaf's, too.
void LeafElements::mention(int slot, const Eigen::Vector2d& reference, int owner) {
  CondensedLandmark& p = records_.landmark(slot);
  if (p.visit == visit_) return;
  Condensed& element = records_.node(owner).own;
  p.visit = visit_;
  p.row = static_cast<int>(element.boundary.size());
  element.boundary.push_back({slot, 0});
  if (p.leaves == 0 && p.leaf != owner) {
    Condensed& home = records_.node(p.leaf).own;
    home.boundary.push_back({slot, 0});
    grow(pool_, home);
    Eigen::Map<Eigen::Vector2d>(&home.reference[home.reference.size() - 2]) = reference;
    ++p.leaves;
  }
  ++p.leaves;
}

/// The leaf of one of its members whose element grows least: so elements stay small.
int LeafElements::owner_of(const FrozenPiece& piece) {
  int best = none;
  std::int64_t least = 0;
  for (const FrozenPiece::Member& m : piece.members) {
    const int leaf = records_.landmark(m.slot).leaf;
    if (leaf == best || leaf == records_.held_leaf) continue;
    ++visit_;
    const std::vector<Condensed::Member>& boundary = records_.node(leaf).own.boundary;
    for (const Condensed::Member& other : boundary) records_.landmark(other.variable).visit = visit_;
    std::int64_t missing = 0;
    for (const FrozenPiece::Member& other : piece.members) {
      if (records_.landmark(other.slot).visit != visit_) ++missing;
    }
    const std::int64_t growth = missing * (missing + 2 * static_cast<std::int64_t>(boundary.size()));
    if (best != none && growth >= least) continue;
    best = leaf;
    least = growth;
  }
  return best != none ? best : records_.held_leaf;
}

}  // namespace seif
