#include "harness/film/point_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

namespace harness {
namespace {

using Eigen::Vector2d;

std::vector<seif::LandmarkId> sorted_within(const PointIndex& index, const Area& area) {
  std::vector<seif::LandmarkId> ids;
  index.within(area, ids);
  std::ranges::sort(ids);
  return ids;
}

TEST(PointIndex, FindsEverythingInAnArea) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> anywhere(-50.0, 50.0);
  PointIndex index(4.0);
  std::vector<Vector2d> points;
  for (int i = 0; i < 2000; ++i) {
    points.emplace_back(anywhere(random), anywhere(random));
    index.put(i, points.back());
  }
  for (int i = 0; i < 2000; i += 3) {  // some move
    points[static_cast<std::size_t>(i)] = {anywhere(random), anywhere(random)};
    index.put(i, points[static_cast<std::size_t>(i)]);
  }
  for (const double size : {0.5, 7.0, 30.0, 200.0}) {
    const Vector2d corner(anywhere(random), anywhere(random));
    const Area area{corner, corner + Vector2d::Constant(size)};
    const std::vector<seif::LandmarkId> found = sorted_within(index, area);
    EXPECT_TRUE(std::ranges::adjacent_find(found) == found.end());
    for (int i = 0; i < 2000; ++i) {
      const Vector2d& p = points[static_cast<std::size_t>(i)];
      const bool is_inside = (p.array() >= area.min.array()).all() && (p.array() <= area.max.array()).all();
      if (!is_inside) continue;
      EXPECT_TRUE(std::ranges::binary_search(found, i)) << i;
    }
  }
}

TEST(PointIndex, GivesNotMuchMoreThanTheArea) {
  PointIndex index(4.0);
  for (int i = 0; i < 100'000; ++i) index.put(i, {i % 400, i / 400});
  std::vector<seif::LandmarkId> ids;
  index.within({{100.0, 100.0}, {110.0, 110.0}}, ids);
  EXPECT_LE(ids.size(), 400U);
}

TEST(PointIndex, KnowsWhereAPointIs) {
  PointIndex index(1.0);
  index.put(7, {1.0, 2.0});
  index.put(7, {-30.0, 2.0});
  EXPECT_EQ(index.size(), 1U);
  EXPECT_EQ(index.position(7), Vector2d(-30.0, 2.0));
  EXPECT_EQ(index.position(8), std::nullopt);
  EXPECT_TRUE(sorted_within(index, {{0.0, 0.0}, {3.0, 3.0}}).empty());
}

TEST(PointIndex, TakesAnAreaOfAnySize) {
  PointIndex index(1.0);
  index.put(1, {0.0, 0.0});
  EXPECT_EQ(sorted_within(index, {{-1e30, -1e30}, {1e30, 1e30}}).size(), 1U);
}

}  // namespace
}  // namespace harness
