#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "sim/simulator.hpp"

namespace sim {
namespace {

using std::numbers::pi;

// Bullet's rays hit a cylinder within 0.07 mm of the exact point. Cases closer than ray_accuracy are not
// tested.
constexpr double ray_accuracy = 1e-3;  // [m]

/// The distance between the path from `from` to `to` and a circle; negative if the path enters the circle. [m]
double clearance(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const worlds::Landmark& circle) {
  const Eigen::Vector2d along = to - from;
  const double share = std::clamp((circle.position - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (from + share * along - circle.position).norm() - circle.radius;
}

/// The smallest clearance from all other landmarks of the ray to a landmark's near face. [m]
double ray_clearance(const worlds::World& world, const Eigen::Vector2d& sensor, std::size_t target) {
  const worlds::Landmark& goal = world.landmarks[target];
  const Eigen::Vector2d face = goal.position + goal.radius * (sensor - goal.position).normalized();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < world.landmarks.size(); ++i) {
    if (i != target) {
      least = std::min(least, clearance(sensor, face, world.landmarks[i]));
    }
  }
  return least;
}

// The world is so crowded that landmarks overlap, and that the sensor is sometimes inside one.
TEST(LineOfSight, MatchesCirclesOnThePlane) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-5.0, 5.0), size(0.02, 0.4);
  int free = 0, hidden = 0;
  for (int trial = 0; trial < 200; ++trial) {
    worlds::World world;
    const Eigen::Vector2d origin = trial % 2 == 0 ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(3000, -2000);
    for (int i = 0; i < 40; ++i) {
      world.landmarks.push_back({origin + Eigen::Vector2d(place(random), place(random)), size(random)});
    }
    const auto simulator = make_simulator(world);
    const Eigen::Vector2d sensor = origin + Eigen::Vector2d(place(random), place(random));
    for (std::size_t i = 0; i < world.landmarks.size(); ++i) {
      const double gap = ray_clearance(world, sensor, i);
      const bool inside = (sensor - world.landmarks[i].position).norm() <= world.landmarks[i].radius;
      if (inside || std::abs(gap) < ray_accuracy) {
        continue;
      }
      EXPECT_EQ(simulator->line_of_sight(sensor, static_cast<int>(i)), gap > 0.0)
          << trial << ' ' << i << ' ' << gap;
      (gap > 0.0 ? free : hidden) += 1;
    }
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(hidden, 1000);
}

// Seen from the origin, a wall from (2, -1) to (2, 1), 0.2 m thick, hides the points whose line of sight meets
// x = 1.9 within |y| <= 1. The whole scene is turned and moved.
TEST(LineOfSight, MatchesAWallOnThePlane) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> angle(-pi, pi), place(-2000.0, 2000.0), jitter(0.1, 0.9);
  int free = 0, hidden = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Rotation2Dd R_world_scene(angle(random));
    const Eigen::Vector2d p_world_scene(place(random), place(random));
    const auto to_world = [&](double x, double y) -> Eigen::Vector2d {
      return p_world_scene + R_world_scene * Eigen::Vector2d(x, y);
    };
    worlds::World world;
    world.walls.push_back({{to_world(2, -1), to_world(2, 1)}, 0.2, 1.0});
    std::vector<double> sides;
    for (int i = 0; i < 20; ++i) {
      sides.push_back(-4.0 + 0.4 * (i + jitter(random)));
      world.landmarks.push_back(
          {to_world(4.0, sides.back()), 0.001});  // too small and too far apart to hide each other
    }
    const auto simulator = make_simulator(world);
    for (int i = 0; i < 20; ++i) {
      const double y = std::abs(sides[static_cast<std::size_t>(i)]) * 1.9 / 4.0;
      if (std::abs(y - 1.0) < ray_accuracy) {
        continue;
      }
      EXPECT_EQ(simulator->line_of_sight(to_world(0, 0), i), y > 1.0) << trial << ' ' << y;
      (y > 1.0 ? free : hidden) += 1;
    }
  }
  EXPECT_GT(free, 500);
  EXPECT_GT(hidden, 500);
}

// Corners and joints of a closed wall, one of them in the middle of a straight side, leave no gap.
TEST(LineOfSight, NothingIsSeenThroughTheJointsOfAWall) {
  worlds::World world;
  const std::vector<Eigen::Vector2d> corners = {{-3, -3}, {0, -3}, {3, -3}, {3, 2}, {1, 3}, {-3, 3}};
  world.walls.push_back({corners, 0.1, 0.5, true});
  for (int i = 0; i < 720; ++i) {
    const double angle = i * pi / 360.0;
    world.landmarks.push_back({8.0 * Eigen::Vector2d(std::cos(angle), std::sin(angle)), 0.01});
  }
  for (const Eigen::Vector2d& corner : corners) {
    world.landmarks.push_back({2.5 * corner, 0.01});
  }
  const auto simulator = make_simulator(world);
  for (int i = 0; i < static_cast<int>(world.landmarks.size()); ++i) {
    EXPECT_FALSE(simulator->line_of_sight({0, 0}, i)) << i;
  }
}

TEST(LineOfSight, BoxesHideAtAnyHeight) {
  worlds::World world;
  world.landmarks = {{{4, 0}, 0.1}, {{4, 3}, 0.1}};
  world.boxes.push_back({{{2, 0}, 0.3}, {0.4, 0.4}, 0.01});
  const auto simulator = make_simulator(world);
  EXPECT_FALSE(simulator->line_of_sight({0, 0}, 0));
  EXPECT_TRUE(simulator->line_of_sight({0, 0}, 1));
}

TEST(LineOfSight, TheNearFaceDecidesForALandmarkThatIsPartlyCovered) {
  worlds::World world;
  world.landmarks = {{{4, 0}, 0.3}, {{4.2, 0.25}, 0.2}, {{3.75, 0.0}, 0.1}};
  // The first landmark sticks out of the second one's side. Seen from -x, only the third one covers its face.
  EXPECT_FALSE(make_simulator(world)->line_of_sight({0, 0}, 0));
  world.landmarks.pop_back();
  EXPECT_TRUE(make_simulator(world)->line_of_sight({0, 0}, 0));
  EXPECT_TRUE(make_simulator(world)->line_of_sight({4.2, 3.0}, 1));
  EXPECT_TRUE(make_simulator(world)->line_of_sight({4.1, 0.0}, 0));  // from within the landmark itself
}

TEST(LineOfSight, RefusesALandmarkThatIsNotThere) {
  worlds::World world;
  world.landmarks = {{{4, 0}, 0.3}};
  world.boxes.push_back({{{2, 5}, 0.0}, {1, 1}, 1.0});
  const auto simulator = make_simulator(world);
  EXPECT_THROW(static_cast<void>(simulator->line_of_sight({0, 0}, 1)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(simulator->line_of_sight({0, 0}, -1)), std::out_of_range);
}

TEST(LandmarksWithin, AreAllWhoseCentresAreInTheDisk) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(-20.0, 20.0), size(0.02, 2.0);
  worlds::World world;
  for (int i = 0; i < 1000; ++i) {
    world.landmarks.push_back({{place(random), place(random)}, size(random)});
  }
  worlds::World with_box = world;
  with_box.boxes.push_back({{{0, 0}, 0.0}, {1, 1}, 1.0});
  world.physics.engine = worlds::Engine::kinematic;
  const auto in_bullet = make_simulator(with_box), kinematic = make_simulator(world);
  std::vector<int> found = {99};
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector2d p(place(random), place(random));
    std::vector<int> expected;
    for (int i = 0; i < 1000; ++i) {
      if ((world.landmarks[static_cast<std::size_t>(i)].position - p).norm() <= 8.0) {
        expected.push_back(i);
      }
    }
    for (const auto* simulator : {in_bullet.get(), kinematic.get()}) {
      simulator->landmarks_within(p, 8.0, found);
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(PathIsClear, WhereADiskFitsBetweenSolids) {
  worlds::World world;
  world.landmarks = {{{5, 1}, 0.2}, {{5, -1}, 0.2}};
  world.boxes.push_back(
      {{{10, 2}, pi / 4}, {std::sqrt(2.0), std::sqrt(2.0)}, 1.0});  // its corner is at (10, 1)
  const auto simulator = make_simulator(world);
  EXPECT_TRUE(simulator->path_is_clear({0, 0}, {8, 0}, 0.799));
  EXPECT_FALSE(simulator->path_is_clear({0, 0}, {8, 0}, 0.801));
  EXPECT_TRUE(simulator->path_is_clear({8, 0}, {200, 0}, 0.999));
  EXPECT_FALSE(simulator->path_is_clear({8, 0}, {200, 0}, 1.001));
  EXPECT_FALSE(simulator->path_is_clear({0, 2}, {20, 2}, 0.0));  // straight through the box
}

TEST(PathIsClear, NotFromAStartThatTouches) {
  worlds::World world;
  world.landmarks = {{{0, 0}, 0.5}};
  for (const worlds::Engine engine : {worlds::Engine::bullet, worlds::Engine::kinematic}) {
    world.physics.engine = engine;
    const auto simulator = make_simulator(world);
    EXPECT_FALSE(simulator->path_is_clear({0.7, 0}, {5, 0}, 0.25));
    EXPECT_FALSE(simulator->path_is_clear({0.1, 0}, {5, 0}, 0.0));
    EXPECT_FALSE(simulator->path_is_clear({0.75, 0}, {0.75, 0}, 0.25));
    EXPECT_TRUE(simulator->path_is_clear({0.76, 0}, {0.76, 0}, 0.25));
  }
}

}  // namespace
}  // namespace sim
