#include "harness/film/trail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace harness {
namespace {

using Eigen::Vector2d;

struct Leg {
  Vector2d from, to;
};

std::vector<Leg> legs_of(const Trail& trail, const Vector2d& head) {
  std::vector<Leg> legs;
  trail.for_each_leg(head, [&](const Vector2d& from, const Vector2d& to) { legs.push_back({from, to}); });
  return legs;
}

TEST(Trail, LeadsFromTheFirstPointToTheHead) {
  Trail trail(0.1);
  for (int i = 0; i < 10; ++i) trail.add({0.2 * i, 0.0});
  const std::vector<Leg> legs = legs_of(trail, {2.0, 0.5});
  ASSERT_EQ(legs.size(), 10U);
  EXPECT_EQ(legs.front().from, Vector2d(0.0, 0.0));
  EXPECT_EQ(legs.back().to, Vector2d(2.0, 0.5));
  for (std::size_t i = 1; i < legs.size(); ++i) EXPECT_EQ(legs[i].from, legs[i - 1].to);
}

TEST(Trail, LeavesOutWhatHardlyMoves) {
  Trail trail(0.1);
  for (int i = 0; i < 1000; ++i) trail.add({1e-5 * i, 0.0});
  EXPECT_EQ(trail.points(), 1U);
}

TEST(Trail, IsBoundedHoweverLongTheWay) {
  Trail trail(0.05);
  for (int i = 0; i < 1'000'000; ++i) trail.add({0.1 * i, 0.0});
  EXPECT_LE(trail.points(), 1600U);
  const std::vector<Leg> legs = legs_of(trail, {1e5, 0.0});
  EXPECT_EQ(legs.front().from, Vector2d(0.0, 0.0));
  EXPECT_NEAR(legs.back().from.x(), 99999.9, 1e-6);
}

TEST(Trail, KeepsTheLastPartFineAndTheRestNearTheWay) {
  Trail trail(0.05);
  const auto way = [](double s) { return Vector2d(50.0 * std::cos(s / 50.0), 50.0 * std::sin(s / 50.0)); };
  for (int i = 0; i < 20'000; ++i) trail.add(way(0.1 * i));
  const std::vector<Leg> legs = legs_of(trail, way(2000.0));
  for (std::size_t i = legs.size() - 200; i < legs.size(); ++i)
    EXPECT_LT((legs[i].to - legs[i].from).norm(), 0.11);
  // At least one point in seven metres of the 2,000 is kept. Such a chord lies 7^2 / (8 50) m inside the
  // circle.
  for (const Leg& leg : legs) EXPECT_NEAR((0.5 * (leg.from + leg.to)).norm(), 50.0, 0.1225);
}

}  // namespace
}  // namespace harness
