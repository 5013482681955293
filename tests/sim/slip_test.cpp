#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "driver.hpp"

namespace sim {
namespace {

/// How much farther the wheels rolled than the robot moved, after three seconds of accelerating at 1 m/s^2. [m]
double slip(const std::vector<worlds::FrictionPatch>& patches) {
  worlds::World world;
  world.physics.patches = patches;
  world.robot.motor_torque = 5.0;
  const auto simulator = make_simulator(world);
  drive_for(*simulator, world, 3.0, {1.0, 0.0});
  return wheel_travel(simulator->robot(), world.robot) - simulator->robot().position.x();
}

// The wheels carry about 3/4 of the weight, and at most all of it, so they cannot push harder than friction * g
// = 0.98 m/s^2. Told to accelerate at 1 m/s^2, they spin until the robot has caught up: after v^2 (1/a_robot -
// 1/a_wheels) / 2.
TEST(Slip, ASlipperyPatchTakesWheelTravelThatTheRobotDoesNotMake) {
  const double on_patch = slip({{{-10, -10}, {10, 10}, 0.1}});
  EXPECT_GT(on_patch, 0.5 * (1.0 / 0.98 - 1.0));
  EXPECT_LT(on_patch, 0.5 * (1.0 / (0.5 * 0.98) - 1.0));
  EXPECT_LT(std::abs(slip({})), 1e-4);
}

TEST(Slip, FollowsThePatchThatCountsWhereTheWheelsStand) {
  const worlds::FrictionPatch slippery{{-10, -10}, {10, 10}, 0.1};
  EXPECT_LT(std::abs(slip({slippery, {{-10, -10}, {10, 10}, 0.9}})), 1e-4);
  EXPECT_LT(std::abs(slip({{{4, -10}, {10, 10}, 0.1}})), 1e-4);  // not reached
  EXPECT_GT(slip({{{-10, -10}, {10, 10}, 0.9}, slippery}), 0.01);
}

// One wheel is on ice: it spins, the other one pushes, and the robot turns towards the ice.
TEST(Slip, EachWheelHasItsOwnGround) {
  worlds::World world;
  world.physics.patches = {{{-10, 0}, {10, 10}, 0.02}};
  world.robot.motor_torque = 5.0;
  const auto simulator = make_simulator(world);
  drive_for(*simulator, world, 1.0, {1.0, 0.0});
  EXPECT_GT(simulator->robot().heading, 0.05);
  EXPECT_GT(simulator->robot().heading - wheel_turn(simulator->robot(), world.robot), 0.05);
}

// Locked wheels on ice: the robot slides on as far as friction allows.
TEST(Slip, ARobotThatBrakesOnIceSlidesOn) {
  worlds::World world;
  world.robot.max_acceleration = 4.0;
  world.physics.patches = {{{2, -10}, {30, 10}, 0.05}};
  const auto simulator = make_simulator(world);
  while (simulator->robot().position.x() < 2.5) {
    simulator->step({1.0, 0.0});
  }
  const RobotState before = simulator->robot();
  drive_for(*simulator, world, 6.0, {0.0, 0.0});
  const RobotState after = simulator->robot();
  EXPECT_LT(std::abs(after.v), 1e-3);
  const double slid = after.position.x() - before.position.x();
  EXPECT_GT(slid,
            0.5 / (0.05 * 9.81));  // more than v^2 / (2 friction g): the caster carries part of the weight
  EXPECT_LT(wheel_travel(after, world.robot) - wheel_travel(before, world.robot), 0.2);
}

}  // namespace
}  // namespace sim
