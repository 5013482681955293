// The search for a place by constellations: it finds the right one, and tells of none in a map that it has never seen.
#include "seif/relocating/constellation_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "seif/association/constellation_index.hpp"

namespace seif {
namespace {

constexpr double sighting_sd = 0.05;  // [m]
constexpr double reach = 6.0;         // [m]

/// A map of landmarks, found by place and by constellation.
struct Map {
  LandmarkGrid grid{1.5};
  ConstellationIndex index{4.0 * sighting_sd};

  void add(const Eigen::Vector2d& p) {
    grid.add(p);
    index.add(grid, static_cast<LandmarkId>(grid.size()) - 1, reach);
  }
};

using Points = std::vector<Eigen::Vector2d>;

Points scattered(int count, double side, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(0.0, side);
  Points points;
  for (int i = 0; i < count; ++i) points.emplace_back(place(random), place(random));
  return points;
}

/// What a robot at T_world_robot has around it, with errors, in its own frame; the nearest first.
Points around(const Points& landmarks, const Pose2& T_world_robot, std::mt19937_64& random) {
  std::normal_distribution<double> error(0.0, 0.4 * sighting_sd);
  Points points;
  for (const Eigen::Vector2d& p : landmarks) {
    const Eigen::Vector2d p_robot = inverse(T_world_robot) * p;
    if (p_robot.norm() <= reach)
      points.emplace_back(p_robot.x() + error(random), p_robot.y() + error(random));
  }
  std::ranges::sort(points, {}, [](const Eigen::Vector2d& p) { return p.norm(); });
  if (points.size() > 24) points.resize(24);
  return points;
}

std::optional<ConstellationSearch::Found> found_in(const Map& map, const Points& points) {
  ConstellationSearch search(map.grid, map.index, 5.0 * sighting_sd);
  for (int scan = 0; scan < 3; ++scan) {
    search.set_points({.p_local = points, .own = {}}, {}, {});
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
      search.set_points({.p_local = points, .own = {}}, {}, {});
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
