// The parts of the condensation tree, each alone, against dense matrices.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "seif/tree/array_pool.hpp"
#include "seif/tree/front.hpp"
#include "seif/tree/hot_zone.hpp"
#include "seif/tree/leaf_tree.hpp"

namespace seif {
namespace {

constexpr double part_rounding = 1e-10;  // relative

Eigen::MatrixXd positive_definite(int n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
  return A * A.transpose() + Eigen::MatrixXd::Identity(n, n);
}

TEST(ArrayPool, HandsOutAgainWhatHasComeBack) {
  ArrayPool pool;
  for (std::size_t size = 1; size < 5000; size += size / 7 + 1) {
    ArrayPool::Array one = pool.take(size);
    std::fill_n(one.data(), size, 1.0);
    const std::size_t bytes = pool.memory_bytes();
    ArrayPool::Array moved = std::move(one);
    EXPECT_EQ(one.size(), 0u);
    EXPECT_EQ(moved.size(), size);
    moved.clear();
    const ArrayPool::Array again = pool.take(size);
    EXPECT_EQ(pool.memory_bytes(), bytes) << size;
    const ArrayPool::Array another = pool.take(size);
    EXPECT_NE(another.data(), again.data());
  }
}

TEST(ArrayPool, WastesAQuarterAtMost) {
  for (std::size_t size = 8; size < 100'000; size += size / 5 + 1) {
    ArrayPool pool;
    const ArrayPool::Array array = pool.take(size);
    EXPECT_GE(pool.memory_bytes(), size * sizeof(double));
    EXPECT_LE(pool.memory_bytes(), (size + size / 4) * sizeof(double)) << size;
  }
}

/// The Schur complement of M over the landmarks `kept`, with the others eliminated.
Eigen::MatrixXd schur_complement(const Eigen::MatrixXd& M, const std::vector<int>& kept) {
  const Eigen::MatrixXd Sigma = M.inverse();
  const auto k = static_cast<Eigen::Index>(kept.size());
  Eigen::MatrixXd part(2 * k, 2 * k);
  for (Eigen::Index i = 0; i < k; ++i) {
    for (Eigen::Index j = 0; j < k; ++j) {
      part.block<2, 2>(2 * i, 2 * j) =
          Sigma.block<2, 2>(2 * kept[static_cast<std::size_t>(i)], 2 * kept[static_cast<std::size_t>(j)]);
    }
  }
  return part.inverse();
}

Eigen::MatrixXd unpacked(const Condensed& condensed) {
  const auto b = 2 * static_cast<Eigen::Index>(condensed.boundary.size());
  Eigen::MatrixXd S(b, b);
  const double* value = condensed.S.data();
  for (Eigen::Index col = 0; col < b; ++col) {
    for (Eigen::Index row = col; row < b; ++row) S(row, col) = S(col, row) = *value++;
  }
  return S;
}

/// All blocks of M for these landmarks, unchanged.
Condensed part_of(const Eigen::MatrixXd& M, const std::vector<int>& slots) {
  Condensed part;
  for (const int slot : slots) part.boundary.push_back({slot, 1});
  part.b = static_cast<int>(M.rows());
  static ArrayPool pool;  // lives longer than all parts
  part.S = pool.take(static_cast<std::size_t>(part.b * (part.b + 1) / 2));
  part.pack(M);
  part.s.assign(static_cast<std::size_t>(part.b), 0.0);
  return part;
}

/// The front of a part; nothing is eliminated.
Condensed condensed(Front& front, const Condensed& part) {
  Condensed out;
  front.begin();
  front.add(part);
  EXPECT_TRUE(front.condense([](int, int) { return false; }, out));
  return out;
}

std::vector<int> boundary_of(const Condensed& condensed) {
  std::vector<int> slots;
  for (const Condensed::Member& m : condensed.boundary) slots.push_back(m.variable);
  return slots;
}

TEST(Front, LeavesTheSchurComplement) {
  Front front;
  const Eigen::MatrixXd M = positive_definite(18, 1);
  front.begin();
  std::vector<int> slots(9);
  std::iota(slots.begin(), slots.end(), 0);
  const Condensed part = part_of(M, slots);
  front.add(part);
  Condensed out;
  ASSERT_TRUE(front.condense([](int slot, int) { return slot % 3 != 0; }, out));
  EXPECT_EQ(boundary_of(out), (std::vector<int>{0, 3, 6}));
  const Eigen::MatrixXd expected = schur_complement(M, {0, 3, 6});
  EXPECT_LT((unpacked(out) - expected).norm(), part_rounding * expected.norm());
}

TEST(Front, ThatTakesInWhatOthersLeaveEqualsOneOfAll) {
  Front front;
  const Eigen::MatrixXd A = positive_definite(10, 2);
  const Eigen::MatrixXd B = positive_definite(10, 3);
  const std::vector<int> of_a{0, 1, 2, 3, 4};
  const std::vector<int> of_b{5, 3, 7, 4, 6};
  const Condensed part_a = part_of(A, of_a);
  const Condensed part_b = part_of(B, of_b);
  Condensed a, b, out;
  front.begin();
  front.add(part_a);
  ASSERT_TRUE(front.condense([](int slot, int) { return slot < 3; }, a));
  front.begin();
  front.add(part_b);
  ASSERT_TRUE(front.condense([](int slot, int) { return slot > 6; }, b));
  front.begin();
  front.add(a);
  front.add(b);
  // Landmarks that only one of the two parts mentions would wait for another part.
  ASSERT_TRUE(front.condense([](int, int leaves) { return leaves == 2; }, out));
  EXPECT_EQ(out.eliminated, (std::vector<int>{3, 4}));

  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(16, 16);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      const auto at = [](const std::vector<int>& slots, int k) {
        return 2 * slots[static_cast<std::size_t>(k)];
      };
      M.block<2, 2>(at(of_a, i), at(of_a, j)) += A.block<2, 2>(2 * i, 2 * j);
      M.block<2, 2>(at(of_b, i), at(of_b, j)) += B.block<2, 2>(2 * i, 2 * j);
    }
  }
  const Eigen::MatrixXd expected = schur_complement(M, boundary_of(out));
  EXPECT_LT((unpacked(out) - expected).norm(), part_rounding * expected.norm());
}

TEST(Front, RefusesWhatIsNotPositiveDefinite) {
  Front front;
  front.begin();
  const Condensed part = part_of(-Eigen::Matrix2d::Identity(), {0});
  front.add(part);
  Condensed out;
  EXPECT_FALSE(front.condense([](int, int) { return true; }, out));
}

/// How landmarks move with a group: [x, y, phi, dilation]. (2n x 4)
Eigen::MatrixXd motion_of_group(const std::vector<Eigen::Vector2d>& levers) {
  Eigen::MatrixXd P(2 * static_cast<Eigen::Index>(levers.size()), 4);
  for (std::size_t i = 0; i < levers.size(); ++i) {
    auto rows = P.middleRows<2>(static_cast<Eigen::Index>(2 * i));
    rows.leftCols<2>().setIdentity();
    rows.col(2) = Eigen::Vector2d(-levers[i].y(), levers[i].x());
    rows.col(3) = levers[i];
  }
  return P;
}

TEST(Front, APartOfOmegaHoldsWhatItHoldsCondensed) {
  Front front;
  const Eigen::MatrixXd M = positive_definite(8, 6);
  Condensed part = part_of(M, {4, 1, 3, 2});
  const Condensed whole = condensed(front, part);
  EXPECT_LT((unpacked(whole) - M).norm(), part_rounding * M.norm());
  EXPECT_EQ(part.boundary_blocks(), whole.boundary_blocks());

  part.s.assign(8, 0.5);
  const Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(8, -1.0, 2.5);
  Eigen::VectorXd r(8);
  part.residual(d, r);
  const Eigen::VectorXd expected = Eigen::VectorXd::Constant(8, 0.5) - M * d;
  EXPECT_LT((r - expected).norm(), part_rounding * expected.norm());
}

// Condensed parts are summed by whole columns, others by blocks.
TEST(Front, PartsAreTiedInEitherForm) {
  Front front;
  const Eigen::MatrixXd M = positive_definite(8, 7);
  const Condensed part = part_of(M, {0, 1, 2, 3});
  const Condensed whole = condensed(front, part);
  const auto tied = [&](const Condensed& taken_in) {
    Condensed out;
    front.begin();
    front.add(taken_in);
    front.tie(0, group_variable(10), Lever(1.0, 2.0));
    front.tie(2, group_variable(10), Lever(-3.0, 0.5));
    EXPECT_TRUE(front.condense([](int v, int) { return v == 1; }, out));
    return out;
  };
  const Condensed by_blocks = tied(part);
  const Condensed by_columns = tied(whole);
  ASSERT_EQ(by_blocks.S.size(), by_columns.S.size());
  for (std::size_t i = 0; i < by_blocks.S.size(); ++i)
    EXPECT_NEAR(by_blocks.S[i], by_columns.S[i], part_rounding * M.norm());
}

// Four landmarks. Three of them move as one: first two of the three are tied, then all three.
TEST(Front, WhatIsTiedMovesAsItsGroup) {
  const Eigen::MatrixXd M = positive_definite(8, 5);
  const std::vector<Eigen::Vector2d> levers{{1.0, 2.0}, {-3.0, 0.5}, {4.0, -1.0}};
  const Eigen::Vector2d centre(7.0, -2.0);  // of the larger group; the smaller one's is the origin
  Front front;
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(8, -1.0, 2.5);
  Condensed landmarks = part_of(M, {0, 1, 2, 3});
  landmarks.s.assign(r.begin(), r.end());
  Condensed pair, all;
  front.begin();
  front.add(landmarks);
  for (const std::size_t i : {0U, 1U}) front.tie(i, group_variable(10), levers[i]);
  ASSERT_TRUE(front.condense([](int, int) { return false; }, pair));
  front.begin();
  front.add(pair);
  for (std::size_t i = 0; i < front.variables().size() && i < 4; ++i) {
    const FrontVariable v = front.variables()[i].variable;
    if (v == 2) front.tie(i, group_variable(11), levers[2] - centre);
    if (v == group_variable(10)) front.tie(i, group_variable(11), -centre);
  }
  ASSERT_TRUE(front.condense([](int v, int) { return v == 3; }, all));

  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(8, 6);
  P.topLeftCorner(6, 4) = motion_of_group({levers[0] - centre, levers[1] - centre, levers[2] - centre});
  P.bottomRightCorner<2, 2>().setIdentity();
  const Eigen::MatrixXd tied = P.transpose() * M * P;
  const Eigen::MatrixXd by_last = tied.topRightCorner(4, 2) * tied.bottomRightCorner<2, 2>().inverse();
  const Eigen::MatrixXd expected = tied.topLeftCorner(4, 4) - by_last * tied.bottomLeftCorner(2, 4);
  ASSERT_EQ(all.b, 4);
  Eigen::MatrixXd S(4, 4);
  all.unpack(S);
  EXPECT_LT((S - expected).norm(), part_rounding * expected.norm());
  const Eigen::VectorXd r_tied = P.transpose() * r;
  const Eigen::VectorXd s = r_tied.head<4>() - by_last * r_tied.tail<2>();
  EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(all.s.data(), 4) - s).norm(), part_rounding * s.norm());
}

TEST(Front, AGroupThatBeginsResistsDilationALittle) {
  const Condensed part = part_of(positive_definite(4, 8), {0, 1});
  const auto tied = [&](Front& front, bool damped) {
    Condensed out;
    front.begin();
    front.add(part);
    front.tie(0, group_variable(3), Lever(1.0, 0.0));
    if (damped) front.damp(group_variable(3));
    EXPECT_TRUE(front.condense([](int, int) { return false; }, out));
    Eigen::MatrixXd S(out.b, out.b);
    out.unpack(S);
    return S;
  };
  Front front;
  const Eigen::MatrixXd more = tied(front, true) - tied(front, false);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, 6);
  expected(5, 5) = 400.0;  // landmark 1 has the first two rows
  EXPECT_LT((more - expected).norm(), 1e-9);
}

// In steps of some columns, as over several updates.
TEST(Front, ManyColumnsAreEliminatedInSteps) {
  constexpr int landmarks = 60;
  const Eigen::MatrixXd M = positive_definite(2 * landmarks, 9);
  std::vector<int> slots(landmarks);
  std::iota(slots.begin(), slots.end(), 0);
  Condensed part = part_of(M, slots);
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(2 * landmarks, -1.0, 3.0);
  part.s.assign(r.begin(), r.end());
  Front front;
  front.begin();
  front.add(part);
  Condensed out;
  front.divide([](int slot, int) { return slot % 20 != 0; }, out);
  while (front.next_part() != nullptr) front.assemble_next({}, {});
  int steps = 0;
  for (; front.has_columns_left(); ++steps) {
    const std::int64_t before = front.blocks_touched();
    ASSERT_TRUE(front.eliminate_next());
    EXPECT_LE(front.blocks_touched() - before, landmarks * (landmarks + 1) / 2);
  }
  EXPECT_EQ(steps, 3);
  front.finish();
  const Eigen::MatrixXd expected = schur_complement(M, {0, 20, 40});
  EXPECT_LT((unpacked(out) - expected).norm(), part_rounding * expected.norm());
  // Where nothing pulls at E, B is pulled by r_B - M_BE M_EE^-1 r_E.
  const Eigen::VectorXd x = M.ldlt().solve(r);
  Eigen::VectorXd s(6);
  for (Eigen::Index i = 0; i < 3; ++i) s.segment<2>(2 * i) = x.segment<2>(40 * i);
  s = (expected * s).eval();
  EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(out.s.data(), 6) - s).norm(), 1e-9 * s.norm());
}

/// A zone of eight landmarks, as a front leaves it.
struct ZoneOfEight {
  ZoneOfEight() {
    Front front;
    std::vector<int> slots(8);
    std::iota(slots.begin(), slots.end(), 0);
    Condensed all = condensed(front, part_of(M, slots));
    all.s.assign(16, 0.0);
    zone.load(all);
  }

  Eigen::MatrixXd F(const std::vector<int>& places) const {
    const auto k = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXd part(2 * k, 2 * k);
    for (Eigen::Index i = 0; i < k; ++i) {
      for (Eigen::Index j = 0; j < k; ++j) {
        part.block<2, 2>(2 * i, 2 * j) =
            zone.block(places[static_cast<std::size_t>(i)], places[static_cast<std::size_t>(j)]);
      }
    }
    return part;
  }

  Eigen::MatrixXd M = positive_definite(16, 4);
  HotZone zone;
};

TEST(HotZone, LandmarksChangeSidesInAnyOrder) {
  ZoneOfEight z;
  const std::vector<int> first{6, 1, 4, 3};
  const std::vector<int> back{3, 6};
  const std::vector<int> second{0};
  ASSERT_TRUE(z.zone.eliminate(first));
  ASSERT_TRUE(z.zone.restore(back));
  ASSERT_TRUE(z.zone.eliminate(second));
  const std::vector<int> active{2, 3, 5, 6, 7};
  for (int a = 0; a < 8; ++a) {
    EXPECT_EQ(z.zone.is_active(a), std::ranges::find(active, a) != active.end());
  }
  const Eigen::MatrixXd expected = schur_complement(z.M, active);
  EXPECT_LT((z.F(active) - expected).norm(), part_rounding * expected.norm());
}

TEST(HotZone, TheEliminatedFollowToWhereNothingPullsAtThem) {
  ZoneOfEight z;
  const std::vector<int> eliminated{1, 4, 7};
  ASSERT_TRUE(z.zone.eliminate(eliminated));
  Eigen::VectorXd means;
  z.zone.follow([](int slot) { return Eigen::Vector2d(0.1 * slot, 1.0); }, means);
  z.zone.set_means(means);
  Eigen::VectorXd d(16);
  for (int a = 0; a < 8; ++a) d.segment<2>(2 * a) = z.zone.mean(a);
  const Eigen::VectorXd r = -z.M * d;
  for (const int a : eliminated) EXPECT_LT(r.segment<2>(2 * a).norm(), part_rounding * z.M.norm());
  EXPECT_EQ(z.zone.mean(2), Eigen::Vector2d(0.2, 1.0));
}

TEST(HotZone, RefusesWhatIsNotPositiveDefinite) {
  ZoneOfEight z;
  z.zone.add_information(2, 2, -1e3 * Eigen::Matrix2d::Identity());
  const Eigen::MatrixXd before = z.F({0, 1, 2, 3, 4, 5, 6, 7});
  const std::vector<int> place{2};
  EXPECT_FALSE(z.zone.eliminate(place));
  EXPECT_EQ(z.F({0, 1, 2, 3, 4, 5, 6, 7}), before);
}

int add_leaf(LeafTree& tree, const Eigen::Vector2d& place) {
  const int leaf = tree.new_leaf();
  tree.widen(leaf, place);
  tree.attach(leaf);
  return leaf;
}

TEST(LeafTree, EachNodeIsAChildOfItsParent) {
  LeafTree tree{Pose2{}};
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
  for (int k = 0; k < 200; ++k) {
    const int leaf = tree.new_leaf();
    tree.widen(leaf, {coordinate(random), coordinate(random)});
    const int inner = tree.attach(leaf);
    ASSERT_EQ(inner == LeafTree::none, k == 0);
    ASSERT_EQ(tree.parent(leaf), inner);
    int roots = 0;
    for (int n = 0; n < tree.size(); ++n) {
      const int above = tree.parent(n);
      if (above == LeafTree::none) {
        ++roots;
        ASSERT_EQ(tree.leaves(n), k + 1);
      } else {
        const auto [a, b] = tree.children(above);
        ASSERT_TRUE(a == n || b == n);
        ASSERT_EQ(tree.leaves(above), tree.leaves(a) + tree.leaves(b));
      }
    }
    ASSERT_EQ(roots, 1);
  }
}

int depth(const LeafTree& tree, int node) {
  int steps = 0;
  for (int n = tree.parent(node); n != LeafTree::none; n = tree.parent(n)) ++steps;
  return steps;
}

TEST(LeafTree, IsNoDeeperThanTheLogarithmOfALongCorridorAsks) {
  LeafTree tree{Pose2{}};
  int deepest = 0;
  for (int k = 0; k < 4096; ++k) add_leaf(tree, {12.0 * k, 0.0});
  for (int n = 0; n < tree.size(); ++n) deepest = std::max(deepest, depth(tree, n));
  EXPECT_LE(deepest, 24);  // twice log2(4096): both coordinates grow along it
}

TEST(LeafTree, IsNoDeeperThanTheLogarithmOfAnAreaAsks) {
  LeafTree tree{Pose2{}};
  const int lanes = 96;
  for (int i = 0; i < lanes * lanes; ++i) {
    const int along = i % lanes;
    add_leaf(tree, {8.0 * (i / lanes % 2 == 0 ? along : lanes - along), 8.0 * (i / lanes)});
  }
  int deepest = 0;
  for (int n = 0; n < tree.size(); ++n) deepest = std::max(deepest, depth(tree, n));
  EXPECT_LE(deepest, 39);  // three times log2(96 * 96); with a branch for each lane it would be 96 and more
}

/// Leaves at scattered places, each as wide as a place.
std::vector<int> scatter_leaves(LeafTree& tree) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> coordinate(-80.0, 80.0);
  std::vector<int> leaves;
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector2d place(coordinate(random), coordinate(random));
    leaves.push_back(add_leaf(tree, place));
  }
  return leaves;
}

TEST(LeafTree, WhatStandsBelowANodeLiesInItsRectangle) {
  LeafTree tree{Pose2{}};
  for (const int leaf : scatter_leaves(tree)) {
    for (int n = tree.parent(leaf); n != LeafTree::none; n = tree.parent(n)) {
      EXPECT_TRUE(tree.box(n).contains(tree.box(leaf))) << leaf << " in " << n;
    }
  }
}

TEST(LeafTree, FindsALeafThatReachesFarOutOfItsRectangle) {
  LeafTree tree{Pose2{}};
  const std::vector<int> leaves = scatter_leaves(tree);
  const auto is_found = [&](int leaf, const Eigen::Vector2d& p) {
    bool found = false;
    tree.for_each_leaf_near(p, 1.0, [&](int near) { found = found || near == leaf; });
    return found;
  };
  int i = 0;
  for (const int leaf : leaves) {  // each to another place
    const Eigen::Vector2d p = Eigen::Vector2d(3000.0 + 50.0 * i, -2000.0 + 20.0 * i);
    EXPECT_FALSE(is_found(leaf, p));
    tree.widen(leaf, p);
    EXPECT_TRUE(is_found(leaf, p));
    ++i;
  }
  const int late = tree.new_leaf();  // wide before it is in the tree
  const Eigen::Vector2d far(-9000.0, 500.0);
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(1.0, 1.0), far}) tree.widen(late, p);
  tree.attach(late);
  EXPECT_TRUE(is_found(late, far));
  for (const int leaf : leaves) {
    for (int n = leaf; n != LeafTree::none; n = tree.parent(n))
      EXPECT_TRUE(tree.cover(n).contains(tree.box(leaf)));
  }
}

TEST(LeafTree, ANodeIsWithinThoseAboveIt) {
  LeafTree tree{Pose2{}};
  scatter_leaves(tree);
  for (int n = 0; n < tree.size(); ++n) {
    std::set<int> above{n};
    for (int i = tree.parent(n); i != LeafTree::none; i = tree.parent(i)) above.insert(i);
    for (int i = 0; i < tree.size(); ++i) EXPECT_EQ(tree.is_within(n, i), above.contains(i));
  }
}

TEST(LeafTree, HoldsAnyNumberOfLeavesAtOnePlace) {
  LeafTree tree{Pose2{}};
  std::vector<int> leaves;
  for (int k = 0; k < 50; ++k) leaves.push_back(add_leaf(tree, {1.0, 2.0}));
  EXPECT_EQ(tree.size(), 99);
  for (const int leaf : leaves) EXPECT_FALSE(tree.is_leaf(tree.parent(leaf)));
}

}  // namespace
}  // namespace seif
