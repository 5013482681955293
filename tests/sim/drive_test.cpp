#include <gtest/gtest.h>

#include "sim/drive_limits.hpp"
#include "sim/ground_friction.hpp"

namespace sim {
namespace {

TEST(DriveLimits, HoldSpeedsAndAccelerations) {
  const worlds::Robot robot;
  constexpr double dt = 0.1;
  EXPECT_DOUBLE_EQ(limited({5.0, 0.0}, {0.0, 0.0}, robot, dt).v, robot.max_acceleration * dt);
  EXPECT_DOUBLE_EQ(limited({5.0, 0.0}, {0.95, 0.0}, robot, dt).v, robot.max_speed);
  EXPECT_DOUBLE_EQ(limited({-5.0, 0.0}, {-1.0, 0.0}, robot, dt).v, -robot.max_speed);
  EXPECT_DOUBLE_EQ(limited({0.0, -9.0}, {0.0, 0.0}, robot, dt).omega, -robot.max_turn_acceleration * dt);
  EXPECT_DOUBLE_EQ(limited({0.0, 9.0}, {0.0, 1.4}, robot, dt).omega, robot.max_turn_rate);
  EXPECT_DOUBLE_EQ(limited({0.0, 0.0}, {0.05, -0.2}, robot, dt).v, 0.0);
  EXPECT_DOUBLE_EQ(limited({0.3, 0.2}, {0.25, 0.0}, robot, dt).v, 0.3);
}

TEST(WheelSpeeds, RollTheCommandedMotion) {
  worlds::Robot robot;
  robot.wheel_radius = 0.1;
  robot.track = 0.4;
  const WheelSpeeds speeds = wheel_speeds({1.0, 0.5}, robot);
  EXPECT_DOUBLE_EQ(speeds.left, 9.0);
  EXPECT_DOUBLE_EQ(speeds.right, 11.0);
}

TEST(GroundFriction, TheLaterPatchWins) {
  worlds::Physics physics;
  physics.friction = 0.8;
  physics.patches = {{{0, 0}, {4, 4}, 0.1}, {{2, 2}, {6, 6}, 0.3}};
  EXPECT_EQ(ground_friction(physics, {1, 1}), 0.1);
  EXPECT_EQ(ground_friction(physics, {3, 3}), 0.3);
  EXPECT_EQ(ground_friction(physics, {5, 5}), 0.3);
  EXPECT_EQ(ground_friction(physics, {5, 1}), 0.8);
}

}  // namespace
}  // namespace sim
