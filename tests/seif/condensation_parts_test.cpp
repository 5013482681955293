// The parts of the condensation tree by themselves, against dense matrices.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "seif/front.hpp"
#include "seif/hot_zone.hpp"
#include "seif/leaf_tree.hpp"

namespace seif {
namespace {

constexpr double rounding = 1e-10;  // relative

Eigen::MatrixXd positive_definite(int n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
  return A * A.transpose() + Eigen::MatrixXd::Identity(n, n);
}

/// Of M over the landmarks `kept`, the others eliminated.
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

void add_all(Front& front, const Eigen::MatrixXd& M, const std::vector<int>& slots) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    front.mention(slots[i]);
    for (std::size_t j = 0; j <= i; ++j) {
      front.add(slots[i], slots[j],
                M.block<2, 2>(2 * static_cast<Eigen::Index>(i), 2 * static_cast<Eigen::Index>(j)));
    }
  }
}

std::vector<int> boundary_of(const Condensed& condensed) {
  std::vector<int> slots;
  for (const Condensed::Mention& m : condensed.boundary) slots.push_back(m.slot);
  return slots;
}

TEST(Front, LeavesTheSchurComplement) {
  Front front;
  for (int slot = 0; slot < 9; ++slot) front.add_landmark();
  const Eigen::MatrixXd M = positive_definite(18, 1);
  front.begin();
  std::vector<int> slots(9);
  std::iota(slots.begin(), slots.end(), 0);
  add_all(front, M, slots);
  Condensed out;
  ASSERT_TRUE(front.condense([](int slot, int) { return slot % 3 != 0; }, out));
  EXPECT_EQ(boundary_of(out), (std::vector<int>{0, 3, 6}));
  const Eigen::MatrixXd expected = schur_complement(M, {0, 3, 6});
  EXPECT_LT((unpacked(out) - expected).norm(), rounding * expected.norm());
}

TEST(Front, ThatTakesInWhatOthersLeaveEqualsOneOfAll) {
  Front front;
  for (int slot = 0; slot < 8; ++slot) front.add_landmark();
  const Eigen::MatrixXd A = positive_definite(10, 2);
  const Eigen::MatrixXd B = positive_definite(10, 3);
  const std::vector<int> of_a{0, 1, 2, 3, 4};
  const std::vector<int> of_b{5, 3, 7, 4, 6};
  Condensed a, b, out;
  front.begin();
  add_all(front, A, of_a);
  ASSERT_TRUE(front.condense([](int slot, int) { return slot < 3; }, a));
  front.begin();
  add_all(front, B, of_b);
  ASSERT_TRUE(front.condense([](int slot, int) { return slot > 6; }, b));
  front.begin();
  front.add(a);
  front.add(b);
  // Those that only one of the two mentions would wait for another.
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
  EXPECT_LT((unpacked(out) - expected).norm(), rounding * expected.norm());
}

TEST(Front, RefusesWhatIsNotPositiveDefinite) {
  Front front;
  front.add_landmark();
  front.begin();
  front.mention(0);
  front.add(0, 0, -Eigen::Matrix2d::Identity());
  Condensed out;
  EXPECT_FALSE(front.condense([](int, int) { return true; }, out));
}

/// A zone of eight landmarks that a front has left behind.
struct ZoneOfEight {
  ZoneOfEight() {
    Front front;
    std::vector<int> slots(8);
    std::iota(slots.begin(), slots.end(), 0);
    for (int slot = 0; slot < 8; ++slot) front.add_landmark();
    front.begin();
    add_all(front, M, slots);
    Condensed out;
    EXPECT_TRUE(front.condense([](int, int) { return false; }, out));
    zone.load(out);
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
  EXPECT_LT((z.F(active) - expected).norm(), rounding * expected.norm());
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
  for (const int a : eliminated) EXPECT_LT(r.segment<2>(2 * a).norm(), rounding * z.M.norm());
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

/// Nodes on the way from a node to the hub, at most as many as the tree has.
int steps_to_hub(const LeafTree& tree, int from) {
  int steps = 0;
  for (int n = from; n != tree.hub() && steps <= tree.size(); n = tree.towards(n)) ++steps;
  return steps;
}

TEST(LeafTree, EveryWayLeadsToTheHubWhereverItMoves) {
  LeafTree tree;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
  std::vector<int> leaves;
  std::vector<int> way;
  for (int k = 0; k < 200; ++k) {
    leaves.push_back(tree.add_leaf({coordinate(random), coordinate(random)}));
    const std::vector<int> some{leaves[random() % leaves.size()], leaves[random() % leaves.size()]};
    tree.move_hub(tree.common_ancestor(some), way);
    for (int n = 0; n < tree.size(); ++n) ASSERT_LE(steps_to_hub(tree, n), tree.size());
    int sources = 0;
    for (int n = 0; n < tree.size(); ++n) tree.for_each_source(n, [&](int) { ++sources; });
    ASSERT_EQ(sources, tree.size() - 1);  // each node but the hub sends to one other
  }
}

TEST(LeafTree, IsNoDeeperThanTheLogarithmOfALongCorridorAsks) {
  LeafTree tree;
  std::vector<int> leaves;
  std::vector<int> way;
  const int count = 4096;
  for (int k = 0; k < count; ++k) leaves.push_back(tree.add_leaf({12.0 * k, 0.0}));
  tree.move_hub(tree.common_ancestor(leaves), way);
  int deepest = 0;
  for (const int leaf : leaves) deepest = std::max(deepest, steps_to_hub(tree, leaf));
  EXPECT_LE(deepest, 24);  // twice log2(4096): both coordinates grow along it
}

TEST(LeafTree, HoldsAnyNumberOfLeavesAtOnePlace) {
  LeafTree tree;
  std::vector<int> leaves;
  for (int k = 0; k < 50; ++k) leaves.push_back(tree.add_leaf({1.0, 2.0}));
  EXPECT_EQ(tree.size(), 99);
  EXPECT_FALSE(tree.is_leaf(tree.common_ancestor(leaves)));
}

}  // namespace
}  // namespace seif
