#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "driver.hpp"

namespace sim {
namespace {

// The chassis ends where the wheels end: one wheel radius ahead of the axle. The gap or overlap that Bullet
// leaves between bodies is smaller than this tolerance.
constexpr double contact_tolerance = 0.01;  // [m]

const Eigen::Vector2d far_away(2000.0, -1500.0);

/// The robot's state after driving on for ten seconds.
RobotState after_driving(const worlds::World& world, double v) {
  const auto simulator = make_simulator(world);
  drive_for(*simulator, world, 10.0, {v, 0.0});
  return simulator->robot();
}

TEST(Collision, ALandmarkFarFromTheOriginStopsTheRobot) {
  worlds::World world;
  world.robot.start.position = far_away;
  world.landmarks.push_back({far_away + Eigen::Vector2d(3.0, 0.0), 0.1});
  const auto simulator = make_simulator(world);
  double furthest = 0.0;
  for (int i = 0; i < 4 * world.physics.step_rate; ++i) {
    simulator->step({1.0, 0.0});
    furthest = std::max(furthest, simulator->robot().position.x() - far_away.x());
  }
  EXPECT_NEAR(furthest, 3.0 - 0.1 - world.robot.wheel_radius, contact_tolerance);
}

TEST(Collision, AWallFarFromTheOriginStopsTheRobot) {
  worlds::World world;
  world.robot.start.position = far_away;
  world.walls.push_back(
      {{far_away + Eigen::Vector2d(4.0, -3.0), far_away + Eigen::Vector2d(4.0, 3.0)}, 0.1, 1.0});
  const RobotState state = after_driving(world, 1.0);
  EXPECT_NEAR(state.position.x() - far_away.x(), 4.0 - 0.05 - world.robot.wheel_radius, contact_tolerance);
  EXPECT_NEAR(state.v, 0.0, 1e-3);
}

// When the robot pushes on, weak motors stall and strong ones spin the wheels; the wall holds in both cases.
TEST(Collision, AWallHoldsWhatPushesAgainstIt) {
  for (const double torque : {0.5, 2.0, 20.0}) {
    for (const double v : {1.0, -1.0}) {
      worlds::World world;
      world.robot.motor_torque = torque;
      world.boxes.push_back({{{2.0, 0.0}, 0.0}, {0.2, 6.0}, 0.3});
      world.boxes.push_back({{{-2.0, 0.0}, 0.0}, {0.2, 6.0}, 0.3});
      const RobotState state = after_driving(world, v);
      const double reach = v > 0.0 ? world.robot.wheel_radius : 0.18 + 0.04;  // the rear: behind the caster
      EXPECT_NEAR(std::abs(state.position.x()), 1.9 - reach, contact_tolerance) << torque << ' ' << v;
      EXPECT_GE(wheel_travel(state, world.robot) / v, 1.9 - reach - contact_tolerance);
    }
  }
}

// A wall that is hit at a shallow angle pushes the front corner aside: the robot continues along the wall.
TEST(Collision, AShallowWallTurnsTheRobotAlongItself) {
  worlds::World world;
  world.walls.push_back({{{-1.0, 0.8}, {9.0, -1.0}}, 0.1, 1.0});
  const RobotState state = after_driving(world, 0.5);
  EXPECT_NEAR(state.heading, std::atan2(-1.8, 10.0), 0.05);
  EXPECT_GT(state.position.x(), 4.0);
  EXPECT_LT(state.position.y(), -0.2);
}

// When the robot drives wildly among solids, it never enters one: a disk inside the chassis stays clear of all
// of them.
TEST(Collision, NothingIsPassedThroughInACrowdedRoom) {
  worlds::World world;
  world.robot.max_speed = 2.0;
  world.robot.max_acceleration = 20.0;
  world.robot.motor_torque = 5.0;
  world.walls.push_back({{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, 0.1, 1.0, true});
  for (int i = 0; i < 12; ++i) {
    const double angle = i * std::numbers::pi / 6.0;
    world.landmarks.push_back({2.0 * Eigen::Vector2d(std::cos(angle), std::sin(angle)), 0.05});
    world.boxes.push_back(
        {{3.2 * Eigen::Vector2d(std::cos(angle), std::sin(angle)), 2.0 * angle}, {0.3, 0.1}, 0.5});
  }
  const auto simulator = make_simulator(world);
  double travelled = 0.0;
  Eigen::Vector2d previous = simulator->robot().position;
  for (int i = 0; i < 60 * world.physics.step_rate; ++i) {
    const int part = i / 150;
    simulator->step({part % 3 == 2 ? -2.0 : 2.0, 1.5 * std::sin(part)});
    const Eigen::Vector2d p = simulator->robot().position;
    ASSERT_TRUE(simulator->path_is_clear(p, p, world.robot.wheel_radius - contact_tolerance)) << i;
    ASSERT_LT(p.cwiseAbs().maxCoeff(), 4.0);
    travelled += (p - previous).norm();
    previous = p;
  }
  EXPECT_GT(travelled, 10.0);
}

// Solids are streamed in and out around the robot as it drives: the last of a long row stops it as the first
// would.
TEST(Collision, SolidsAreThereHoweverFarTheRobotHasDriven) {
  worlds::World world;
  for (int i = 0; i < 40; ++i) {
    world.landmarks.push_back({{i, 0.5}, 0.1});
    world.landmarks.push_back({{i, -0.5}, 0.1});
  }
  world.boxes.push_back({{{30.0, 0.0}, 0.0}, {0.2, 0.5}, 1.0});
  const auto simulator = make_simulator(world);
  drive_for(*simulator, world, 35.0, {1.0, 0.0});
  EXPECT_NEAR(simulator->robot().position.x(), 30.0 - 0.1 - world.robot.wheel_radius, contact_tolerance);
}

}  // namespace
}  // namespace sim
