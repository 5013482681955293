// The search for a place by constellations: it finds the right one, and tells of none in a map that it has never seen.
#include "seif/relocating/constellation_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "seif/association/constellation_index.hpp"
#include "seif/relocating/scattered.hpp"

namespace seif {
namespace {

using test::Points;
using test::reach;
using test::scattered;
using test::sighting_sd;

/// A map of landmarks, found by place and by constellation.
struct Map {
  LandmarkGrid grid{1.5};
  ConstellationIndex index{4.0 * sighting_sd};

  void add(const Eigen::Vector2d& p) {
    grid.add(p);
    index.add(grid, static_cast<LandmarkId>(grid.size()) - 1, reach);
  }
};

Points around(const Points& landmarks, const Pose2& T_world_robot, std::mt19937_64& random) {
  return test::around(landmarks, T_world_robot, 0.4 * sighting_sd, 24, random);
}

std::optional<ConstellationSearch::Found> found_in(const Map& map, const Points& points) {
  ConstellationSearch search(map.grid, map.index, 5.0 * sighting_sd);
  for (int scan = 0; scan < 3; ++scan) {
    search.set_points({.p_local = points}, {}, {});
    search.look_around();
  }
  return search.best();
}

TEST(ConstellationSearch, FindsThePlaceWhereverTheRobotStandsAndHoweverItIsTurned) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(10.0, 50.0);
  std::uniform_real_distribution<double> turn(-std::numbers::pi, std::numbers::pi);
  int found = 0;
  constexpr int tries = 50;
  for (int i = 0; i < tries; ++i) {
    const Points landmarks = scattered(500, 60.0, random);
    Map map;
    for (const Eigen::Vector2d& p : landmarks) map.add(p);
    const Pose2 there{place(random), place(random), turn(random)};
    const auto pose = found_in(map, around(landmarks, there, random));
    if (!pose) continue;
    ++found;
    EXPECT_NEAR(pose->T_world_local.x, there.x, 0.2);
    EXPECT_NEAR(pose->T_world_local.y, there.y, 0.2);
    EXPECT_NEAR(wrap_angle(pose->T_world_local.theta - there.theta), 0.0, 0.05);
  }
  EXPECT_GE(found, tries * 9 / 10);
}

/// How many of the points have a landmark within `near`, for the best of all poses that two points and two landmarks give.
std::size_t most_by_brute_force(const Points& landmarks, const Points& points, double near) {
  std::size_t most = 0;
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double apart = (points[a] - points[b]).norm();
      for (const Eigen::Vector2d& to_a : landmarks) {
        for (const Eigen::Vector2d& to_b : landmarks) {
          if (std::abs((to_a - to_b).norm() - apart) > near) continue;
          const Pose2 T = pose_from(points[a], points[b], to_a, to_b);
          most = std::max(most, static_cast<std::size_t>(std::ranges::count_if(points, [&](const auto& p) {
                            return std::ranges::any_of(
                                landmarks, [&](const auto& m) { return (m - T * p).norm() <= near; });
                          })));
        }
      }
    }
  }
  return most;
}

// A quarter of the maps repeats itself, turned and moved; the robot sees a third of clutter.
TEST(ConstellationSearch, TellsOfNoPlaceThatBruteForceWouldNotPrefer) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(0.0, 20.0);
  int told = 0;
  int told_in_symmetric_map = 0;
  for (int i = 0; i < 60; ++i) {
    Points landmarks = scattered(36, 20.0, random);
    const bool is_symmetric = i % 4 == 0;
    const Pose2 T_copy{80.0, 5.0, 2.0};
    for (std::size_t k = 0; is_symmetric && k < 36; ++k) landmarks.push_back(T_copy * landmarks[k]);
    Map map;
    for (const Eigen::Vector2d& p : landmarks) map.add(p);
    const Pose2 there{place(random), place(random), 0.3 * i};
    Points points = around(landmarks, there, random);
    if (points.size() < 6) continue;
    points.resize(std::min<std::size_t>(points.size(), 10));
    for (const Eigen::Vector2d& p : scattered(static_cast<int>(points.size()) / 2, 8.0, random))
      points.push_back(p - Eigen::Vector2d(4.0, 4.0));
    const auto found = found_in(map, points);
    if (!found) continue;
    ++told;
    if (is_symmetric) ++told_in_symmetric_map;
    EXPECT_GE(found->pairs.size() + 1, most_by_brute_force(landmarks, points, 3.0 * sighting_sd))
        << "map " << i;
    EXPECT_NEAR(found->T_world_local.x, there.x, 0.3) << "map " << i;
    EXPECT_NEAR(found->T_world_local.y, there.y, 0.3) << "map " << i;
  }
  EXPECT_GE(told, 25);
  EXPECT_EQ(told_in_symmetric_map, 0);
}

// A lattice looks the same from every point of it.
TEST(ConstellationSearch, TellsOfNoPlaceWhereManyLookTheSame) {
  std::mt19937_64 random(2);
  Points landmarks;
  for (int i = 0; i < 400; ++i) landmarks.emplace_back(2.0 * (i % 20), 4.0 * (i / 20));  // NOLINT
  Map map;
  for (const Eigen::Vector2d& p : landmarks) map.add(p);
  EXPECT_FALSE(found_in(map, around(landmarks, {21.0, 42.0, 0.3}, random)));
}

TEST(ConstellationSearch, LooksAtABoundedNumberOfPosesHoweverLargeTheMap) {
  std::mt19937_64 random(3);
  for (const int count : {1000, 10'000, 50'000}) {
    const Points landmarks = scattered(count, std::sqrt(count / 0.15), random);
    Map map;
    for (const Eigen::Vector2d& p : landmarks) map.add(p);
    ConstellationSearch search(map.grid, map.index, 5.0 * sighting_sd);
    const Points points =
        around(scattered(count, std::sqrt(count / 0.15), random), {15.0, 15.0, 0.0}, random);
    std::int64_t before = 0;
    for (int scan = 0; scan < 5; ++scan) {
      search.set_points({.p_local = points}, {}, {});
      search.look_around();
      EXPECT_LE(search.work() - before, 30'000) << count;
      before = search.work();
    }
  }
}

TEST(ConstellationIndex, FindsATriangleBySidesThatAreALittleWrong) {
  Map map;
  for (const Eigen::Vector2d& p : Points{{0.0, 0.0}, {3.0, 0.0}, {1.0, 2.0}, {20.0, 20.0}}) map.add(p);
  const auto corners_like = [&](const Eigen::Vector3d& sides) {
    std::vector<std::array<LandmarkId, 3>> all;
    map.index.for_each_like(sides, [&](const std::array<LandmarkId, 3>& corners) { all.push_back(corners); });
    return all;
  };
  const Eigen::Vector3d sides(3.0, std::sqrt(8.0), std::sqrt(5.0));
  for (const double error : {-0.09, 0.0, 0.09}) {
    const auto all = corners_like(sides.array() + error);
    ASSERT_EQ(all.size(), 1U) << error;
    EXPECT_EQ(all.front(), (std::array<LandmarkId, 3>{0, 1, 2}));
  }
  EXPECT_TRUE(corners_like({3.0, std::sqrt(5.0), std::sqrt(8.0)}).empty())
      << "its mirror image is another one";
}

}  // namespace
}  // namespace seif
