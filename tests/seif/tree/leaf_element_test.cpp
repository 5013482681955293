// The element of a leaf: sums of frozen pieces, and how it moves as a whole.
#include "seif/tree/leaf_element.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "seif/packed_triangle.hpp"
#include "seif/tree/body_motion.hpp"
#include "seif/tree/moved_boundary.hpp"

namespace seif {
namespace {

constexpr double rounding = 1e-11;  // [-]

/// Landmarks at random places, and pieces over some of them that hold no information about moving or turning all.
struct Pieces {
  explicit Pieces(unsigned seed) : random(seed) {
    std::uniform_real_distribution<double> anywhere(-10.0, 10.0);
    for (int i = 0; i < 7; ++i) places.emplace_back(100.0 + anywhere(random), anywhere(random));
  }

  FrozenPiece piece(const std::vector<int>& slots) {
    const auto n = static_cast<Eigen::Index>(2 * slots.size());
    Eigen::MatrixXd modes(n, 3);
    Eigen::MatrixXd V(n, 2);
    for (Eigen::Index i = 0; i < n; i += 2) {
      const Eigen::Vector2d& p = places[static_cast<std::size_t>(slots[static_cast<std::size_t>(i / 2)])];
      modes.middleRows<2>(i) << 1, 0, -p.y(), 0, 1, p.x();
      for (Eigen::Index k = 0; k < 4; ++k) V(i + k / 2, k % 2) = normal(random);
    }
    V -= modes * modes.householderQr().solve(V);
    FrozenPiece piece;
    piece.slots = {slots.front()};
    for (const int slot : slots) piece.members.push_back({slot, places[static_cast<std::size_t>(slot)]});
    const Eigen::MatrixXd Omega = V * V.transpose();
    piece.Omega.resize(static_cast<std::size_t>(packed_size(n)));
    pack_triangle(Omega, piece.Omega.data());
    const Eigen::VectorXd r = V * Eigen::Vector2d(normal(random), normal(random));
    piece.r.assign(r.begin(), r.end());
    return piece;
  }

  std::mt19937_64 random;
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector2d> places;  // p_world by slot [m]
};

/// Adds a piece as the tree does, with slots in the order in which they come.
void add_to(Condensed& element, const FrozenPiece& piece, ArrayPool& pool) {
  const auto index_of = [&](int slot) {
    int i = 0;
    for (const Condensed::Member& m : element.boundary) {
      if (m.variable == slot) return i;
      ++i;
    }
    return -1;
  };
  for (const FrozenPiece::Member& m : piece.members) {
    if (index_of(m.slot) < 0) element.boundary.push_back({m.slot, 0});
  }
  add_piece(piece, index_of, pool, element);
}

Eigen::Index row_of(const Condensed& element, int slot) {
  Eigen::Index row = 0;
  for (const Condensed::Member& m : element.boundary) {
    if (m.variable == slot) break;
    row += 2;
  }
  return row;
}

Eigen::VectorXd residual_at(const Condensed& element, const std::vector<Eigen::Vector2d>& places) {
  Eigen::VectorXd d(element.b);
  for (const Condensed::Member& m : element.boundary) {
    const Eigen::Index row = row_of(element, m.variable);
    d.segment<2>(row) = places[static_cast<std::size_t>(m.variable)] -
                        Eigen::Map<const Eigen::Vector2d>(&element.reference[static_cast<std::size_t>(row)]);
  }
  Eigen::VectorXd r(element.b);
  element.residual(d, r);
  return r;
}

TEST(LeafElement, IsTheSumOfItsPieces) {
  Pieces pieces(1);
  ArrayPool pool;
  Condensed element;
  std::vector<FrozenPiece> all;
  for (const std::vector<int>& slots : {std::vector{0, 1, 2}, {3, 1, 4, 0}, {2, 5, 6}}) {
    all.push_back(pieces.piece(slots));
    add_to(element, all.back(), pool);
    for (Eigen::Vector2d& p : pieces.places) p += 0.1 * Eigen::Vector2d(pieces.normal(pieces.random), 0.2);
  }
  const Eigen::VectorXd r = residual_at(element, pieces.places);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(element.b);
  for (const FrozenPiece& piece : all) {
    const auto mean_of = [&](int slot) { return pieces.places[static_cast<std::size_t>(slot)]; };
    for (std::size_t i = 0; i < piece.members.size(); ++i)
      sum.segment<2>(row_of(element, piece.members[i].slot)) += residual_of(piece, i, mean_of);
  }
  EXPECT_LT((r - sum).norm(), rounding * sum.norm());
}

TEST(LeafElement, APieceHoldsItsBlocksAndPullsByThem) {
  Pieces pieces(4);
  const FrozenPiece piece = pieces.piece({0, 2, 5, 3});
  Eigen::MatrixXd Omega(8, 8);
  unpack_triangle(piece.Omega.data(), Omega);
  Eigen::VectorXd d(8), r(8);
  for (Eigen::Index i = 0; i < 8; ++i) d(i) = pieces.normal(pieces.random);
  const auto mean_of = [&](int slot) -> Eigen::Vector2d {
    Eigen::Index i = 0;
    while (piece.members[static_cast<std::size_t>(i)].slot != slot) ++i;
    return piece.members[static_cast<std::size_t>(i)].reference + d.segment<2>(2 * i);
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_EQ(piece.block(i, j), (Omega.block<2, 2>(row, static_cast<Eigen::Index>(2 * j))));
    r.segment<2>(row) = residual_of(piece, i, mean_of);
  }
  const Eigen::VectorXd expected = Eigen::Map<const Eigen::VectorXd>(piece.r.data(), 8) - Omega * d;
  EXPECT_LT((r - expected).norm(), rounding * expected.norm());
}

TEST(LeafElement, TurnedAndShiftedAsAWholeItFeelsNoPull) {
  Pieces pieces(2);
  ArrayPool pool;
  Condensed element;
  for (const std::vector<int>& slots : {std::vector{0, 1, 2, 3}, {4, 1, 5, 6}}) {
    FrozenPiece piece = pieces.piece(slots);
    std::ranges::fill(piece.r, 0.0);
    add_to(element, piece, pool);
  }
  std::vector<Eigen::Vector2d> moved = pieces.places;
  BodyFit fit;
  fit.begin(20.0);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i] = Eigen::Rotation2Dd(0.5) * moved[i] + Eigen::Vector2d(30.0, -7.0);
    fit.add(pieces.places[i], moved[i]);
  }
  const double unturned = residual_at(element, moved).norm();
  ElementMover().turn(fit.fit(), element);
  EXPECT_LT(residual_at(element, moved).norm(), 1e-9 * unturned);
}

TEST(LeafElement, TurnsItsMatrixAndItsResidual) {
  Pieces pieces(3);
  ArrayPool pool;
  Condensed element;
  add_to(element, pieces.piece({0, 1, 2, 3, 4}), pool);
  Eigen::MatrixXd before(element.b, element.b);
  element.unpack(before);
  const Eigen::VectorXd s = Eigen::Map<const Eigen::VectorXd>(element.s.data(), element.b);
  BodyFit fit;
  fit.begin(20.0);
  for (const Eigen::Vector2d& p : pieces.places) fit.add(p, Eigen::Rotation2Dd(-0.3) * p);
  ElementMover().turn(fit.fit(), element);
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(element.b, element.b);
  for (int i = 0; i < element.b; i += 2) R.block<2, 2>(i, i) = Eigen::Rotation2Dd(-0.3).toRotationMatrix();
  Eigen::MatrixXd now(element.b, element.b);
  element.unpack(now);
  EXPECT_LT((now - R * before * R.transpose()).norm(), 1e-10 * before.norm());
  EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(element.s.data(), element.b) - R * s).norm(),
            1e-10 * s.norm());
}

/// What it says of its shape, and how much it pulls, is the same before and after.
TEST(LeafElement, IsCarriedToWhereItsLandmarksAre) {
  Pieces pieces(5);
  ArrayPool pool;
  Condensed element;
  for (const std::vector<int>& slots : {std::vector{0, 1, 2, 3}, {4, 1, 5, 6}})
    add_to(element, pieces.piece(slots), pool);
  std::vector<MovedPlace> places;
  for (const Condensed::Member& m : element.boundary) {
    const Eigen::Vector2d before = pieces.places[static_cast<std::size_t>(m.variable)];
    const Eigen::Vector2d strain =
        0.01 * Eigen::Vector2d(pieces.normal(pieces.random), pieces.normal(pieces.random));
    places.push_back({.before = before, .now = Eigen::Rotation2Dd(0.3) * before + strain});
  }
  const Turning by_clusters{.near = 20.0};
  MovedBoundary moved;
  const auto residual_now = [&] {
    Eigen::VectorXd d(element.b), r(element.b);
    for (std::size_t i = 0; i < places.size(); ++i)
      d.segment<2>(static_cast<Eigen::Index>(2 * i)) = moved.step(i);
    element.residual(d, r);
    moved.bring_residual(r);
    return r;
  };
  moved.fit(by_clusters, places);
  const Eigen::VectorXd before = residual_now();
  ElementMover().carry(by_clusters, places, element);
  for (MovedPlace& place : places) place.before = place.now;
  moved.fit(by_clusters, places);
  EXPECT_LT((residual_now() - before).norm(), rounding * before.norm());
  // The same a second time, from elsewhere: the sum of two steps.
  for (MovedPlace& place : places) place.now = Eigen::Rotation2Dd(-0.7) * place.before;
  moved.fit(by_clusters, places);
  const Eigen::VectorXd turned = residual_now();
  for (Eigen::Index row = 0; row < element.b; row += 2)
    EXPECT_LT((turned.segment<2>(row) - Eigen::Rotation2Dd(-0.7) * before.segment<2>(row)).norm(),
              1e-9 * before.norm());
}

}  // namespace
}  // namespace seif
