// The element of a leaf: the sum of all that was frozen with its landmarks, over these and the landmarks that they
// are linked to. It is positive semidefinite, and holds no information about moving or turning everything.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "seif/freezing.hpp"
#include "seif/tree/array_pool.hpp"
#include "seif/tree/body_motion.hpp"
#include "seif/tree/condensed.hpp"
#include "seif/tree/moved_part.hpp"

namespace seif {

/// Adds a piece to an element, a Condensed without E. `index_of(slot)` is the place of each of the piece's members in
/// the boundary; members that are new there have been appended to it, and have no rows yet.
template <class IndexOf>
void add_piece(const FrozenPiece& piece, IndexOf&& index_of, ArrayPool& pool, Condensed& element);

/// Gives rows to the members that have been appended to the boundary: without information, at `reference`.
void grow(ArrayPool& pool, Condensed& element);

/// Moves elements as a whole: the reference, and with it matrix and residual.
class ElementMover {
 public:
  void turn(const BodyMotion& motion, Condensed& element);
  /// Its landmarks are at `places` now: these become its reference, with what it says, and how it pulls, there. It says
  /// nothing of moving and turning them from there.
  void carry(const Turning& turning, std::span<const MovedPlace> places, Condensed& element);

 private:
  MovedPart moved_;
  Eigen::VectorXd square_;  // (b x b), with room to grow
};

/// The residual of a piece's member i where the members are at mean_of(slot).
template <class MeanOf>
Eigen::Vector2d residual_of(const FrozenPiece& piece, std::size_t i, MeanOf&& mean_of) {
  Eigen::Vector2d r(piece.r[2 * i], piece.r[2 * i + 1]);
  for (std::size_t j = 0; j < piece.members.size(); ++j)
    r -= piece.block(i, j) * (mean_of(piece.members[j].slot) - piece.members[j].reference);
  return r;
}

template <class IndexOf>
void add_piece(const FrozenPiece& piece, IndexOf&& index_of, ArrayPool& pool, Condensed& element) {
  const Eigen::Index b_before = static_cast<Eigen::Index>(element.reference.size());
  grow(pool, element);
  const auto row_of = [&](int slot) { return 2 * Eigen::Index{index_of(slot)}; };
  for (const FrozenPiece::Member& m : piece.members) {
    if (row_of(m.slot) < b_before) continue;
    Eigen::Map<Eigen::Vector2d>(&element.reference[static_cast<std::size_t>(row_of(m.slot))]) = m.reference;
  }
  const auto reference_of = [&](int slot) -> Eigen::Vector2d {
    return Eigen::Map<const Eigen::Vector2d>(&element.reference[static_cast<std::size_t>(row_of(slot))]);
  };
  for (std::size_t i = 0; i < piece.members.size(); ++i) {
    const Eigen::Index row = row_of(piece.members[i].slot);
    Eigen::Map<Eigen::Vector2d>(&element.s[static_cast<std::size_t>(row)]) +=
        residual_of(piece, i, reference_of);
    for (std::size_t j = 0; j < piece.members.size(); ++j) {
      const Eigen::Index col = row_of(piece.members[j].slot);
      if (col <= row) element.add_to_S(row, col, piece.block(i, j));
    }
  }
}

}  // namespace seif
