#include "harness/figures/downsampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace harness {
namespace {

using Values = std::vector<double>;

TEST(SmallestAndLargest, MatchesTheCaseByHand) {
  // Two parts, [0, 4) and [4, 8]. In the first part the smallest value is before the largest, in the second
  // after it.
  const Points kept = smallest_and_largest({{0, 1, 2, 3, 4, 5, 6, 7, 8}, {5, 1, 9, 5, 5, 8, 5, 2, 5}}, 2);
  EXPECT_EQ(kept.x, (Values{1, 2, 5, 7}));
  EXPECT_EQ(kept.y, (Values{1, 9, 8, 2}));
}

TEST(SmallestAndLargest, LeavesShortCurvesAsTheyAre) {
  const Points kept = smallest_and_largest({{0, 1, 2, 3}, {5, 5, 5, 5}}, 2);
  EXPECT_EQ(kept.x, (Values{0, 1, 2, 3}));
  EXPECT_TRUE(smallest_and_largest({}, 2).x.empty());
}

TEST(SmallestAndLargest, SkipsStretchesWithoutPointsAndKeepsEqualValuesOnce) {
  const Points kept = smallest_and_largest({{0, 0.1, 0.2, 9, 9.1, 9.2, 10}, {3, 3, 3, 1, 1, 2, 1}}, 3);
  EXPECT_EQ(kept.x, (Values{0, 9, 9.2}));
  EXPECT_EQ(kept.y, (Values{3, 1, 2}));
}

TEST(SmallestAndLargest, LosesNoPeakOfALongCurve) {
  Points points;
  for (int i = 0; i < 100'000; ++i) {
    points.x.push_back(0.05 * i);
    points.y.push_back(i == 77'777 ? 100.0 : i % 7);
  }
  const Points kept = smallest_and_largest(points, 1'000);
  EXPECT_LE(kept.x.size(), 2'000U);
  EXPECT_TRUE(std::ranges::is_sorted(kept.x));
  const auto peak = std::ranges::max_element(kept.y);
  EXPECT_EQ(*peak, 100.0);
  EXPECT_EQ(kept.x[static_cast<std::size_t>(peak - kept.y.begin())], 0.05 * 77'777);
}

TEST(SmallestAndLargest, TakesPointsAtOneMoment) {
  EXPECT_EQ(smallest_and_largest({{2, 2, 2, 2, 2}, {1, 5, 3, 0, 4}}, 2).y, (Values{5, 0}));
}

TEST(Thinned, KeepsBothEnds) {
  Points points;
  for (int i = 0; i < 11; ++i) {
    points.x.push_back(i);
    points.y.push_back(-i);
  }
  EXPECT_EQ(thinned(points, 3).x, (Values{0, 5, 10}));
  EXPECT_EQ(thinned(points, 3).y, (Values{0, -5, -10}));
  EXPECT_EQ(thinned(points, 11).x, points.x);
}

}  // namespace
}  // namespace harness
