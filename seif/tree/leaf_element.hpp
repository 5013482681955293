// The element of a leaf: the sum of all that was frozen with its landmarks, over these and the landmarks that they
// are linked to. It is positive semidefinite, and holds no information about moving or turning everything.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "seif/freezing.hpp"
#include "seif/tree/array_pool.hpp"
#include "seif/tree/body_motion.hpp"
#include "seif/tree/condensed.hpp"
#include "seif/tree/moved_boundary.hpp"

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
  /// Its landmarks are at `places` now, where it has the residual r (b): these become its reference and its s. It says
  /// nothing of moving and turning them from there.
  void carry(MovedBoundary& moved, std::span<const MovedPlace> places,
             const Eigen::Ref<const Eigen::VectorXd>& r, Condensed& element);

 private:
  Eigen::Map<Eigen::MatrixXd> unpacked(const Condensed& element);

  Eigen::VectorXd square_;  // (b x b), with room to grow
};

/// The residual that a piece has where its members are at mean_of(slot): V times the result (2 x 1).
template <class MeanOf>
Eigen::Vector2d residual_of(const FrozenPiece& piece, MeanOf&& mean_of) {
  Eigen::Vector2d y = piece.y;
  for (const FrozenPiece::Member& m : piece.members) y -= m.V.transpose() * (mean_of(m.slot) - m.reference);
  return y;
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
  const Eigen::Vector2d y = residual_of(piece, [&](int slot) {
    return Eigen::Vector2d(
        Eigen::Map<const Eigen::Vector2d>(&element.reference[static_cast<std::size_t>(row_of(slot))]));
  });
  for (const FrozenPiece::Member& m : piece.members) {
    const Eigen::Index i = row_of(m.slot);
    Eigen::Map<Eigen::Vector2d>(&element.s[static_cast<std::size_t>(i)]) += m.V * y;
    for (const FrozenPiece::Member& n : piece.members) {
      const Eigen::Index j = row_of(n.slot);
      if (j <= i) element.add_to_S(i, j, m.V * n.V.transpose());
    }
  }
}

}  // namespace seif
