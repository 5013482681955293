#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "driver.hpp"

namespace sim {
namespace {

using std::numbers::pi;

struct Spin {
  double true_turn = 0.0;  // [rad] unwrapped
  double read_turn = 0.0;  // [rad] by the wheels
  double distance = 0.0;   // [m] from the start, at the end
};

Spin spin(const worlds::World& world, double turn, const Command& command) {
  const auto simulator = make_simulator(world);
  Spin result;
  double previous = world.robot.start.heading;
  RobotState state;
  while (std::abs(result.true_turn) < turn && state.t < 200.0) {
    simulator->step(command);
    state = simulator->robot();
    result.true_turn += std::remainder(state.heading - previous, 2.0 * pi);
    previous = state.heading;
  }
  result.read_turn = wheel_turn(state, world.robot);
  result.distance = (state.position - world.robot.start.position).norm();
  return result;
}

TEST(Motion, EncodersReadASpinWithin5e4) {
  const worlds::World world;
  for (const double omega : {0.3, 1.0, 1.5, -1.0}) {
    const Spin s = spin(world, 20.0, {0.0, omega});
    EXPECT_GT(s.true_turn * omega, 0.0);
    EXPECT_NEAR(s.read_turn / s.true_turn, 1.0, 5e-4) << omega;
    EXPECT_LT(s.distance, 1e-3);
  }
}

TEST(Motion, EncodersReadTheTurnOfAnArcWithin5e4) {
  const Spin s = spin({}, 20.0, {0.5, 0.5});
  EXPECT_NEAR(s.read_turn / s.true_turn, 1.0, 5e-4);
}

// A small, light robot and a large, heavy one reach the same relative accuracy.
TEST(Motion, EncodersReadASpinOfRobotsOfOtherSizes) {
  worlds::World small;
  small.robot.mass = 1.0;
  small.robot.wheel_mass = 0.1;
  small.robot.wheel_radius = 0.05;
  small.robot.track = 0.16;
  small.robot.motor_torque = 0.2;
  small.robot.caster = {-0.08, 0.02};
  worlds::World large;
  large.robot.mass = 80.0;
  large.robot.wheel_mass = 3.0;
  large.robot.wheel_radius = 0.2;
  large.robot.track = 0.9;
  large.robot.motor_torque = 40.0;
  large.robot.caster = {0.5, 0.08};
  for (const worlds::World& world : {small, large}) {
    const Spin s = spin(world, 20.0, {0.0, 1.0});
    EXPECT_NEAR(s.read_turn / s.true_turn, 1.0, 5e-4) << world.robot.mass;
  }
}

TEST(Motion, EncodersReadAStraightLineWithin1e3) {
  const worlds::World world;
  const auto simulator = make_simulator(world);
  while (simulator->robot().position.x() < 10.0 && simulator->robot().t < 30.0) {
    simulator->step({1.0, 0.0});
  }
  const RobotState state = simulator->robot();
  EXPECT_GE(state.position.x(), 10.0);
  EXPECT_NEAR(wheel_travel(state, world.robot) / state.position.x(), 1.0, 1e-3);
  EXPECT_NEAR(state.position.y(), 0.0, 1e-3);
}

TEST(Motion, DrivesWhatItIsToldWithinOnePerCent) {
  const worlds::World world;
  const auto simulator = make_simulator(world);
  drive_for(*simulator, world, 5.0, {0.6, 0.4});
  EXPECT_NEAR(simulator->robot().v, 0.6, 0.006);
  EXPECT_NEAR(simulator->robot().omega, 0.4, 0.004);
}

void expect_holds_still(Simulator& simulator, const worlds::World& world) {
  const RobotState before = simulator.robot();
  drive_for(simulator, world, 60.0, {0.0, 0.0});
  const RobotState after = simulator.robot();
  EXPECT_LT((after.position - before.position).norm(), 1e-4);
  EXPECT_LT(std::abs(after.heading - before.heading), 0.001 * pi / 180.0);
}

TEST(Motion, HoldsStillFromTheStartAndAfterDriving) {
  const worlds::World world;
  const auto simulator = make_simulator(world);
  expect_holds_still(*simulator, world);
  drive_for(*simulator, world, 5.0, {0.5, 0.7});
  drive_for(*simulator, world, 2.0, {0.0, 0.0});
  expect_holds_still(*simulator, world);
}

// The motors follow the limited command up to the softness of the contacts: a few mm/s, and for accelerations
// over a tenth of a second a few per cent.
TEST(Motion, KeepsItsSpeedAndAccelerationLimits) {
  const worlds::World world;
  const auto simulator = make_simulator(world);
  const int window = world.physics.step_rate / 10;
  std::vector<RobotState> states{simulator->robot()};
  for (int i = 0; i < 12 * world.physics.step_rate; ++i) {
    const double sign = (i / (3 * world.physics.step_rate)) % 2 == 0 ? 1.0 : -1.0;
    simulator->step({sign * 100.0, sign * 100.0});
    states.push_back(simulator->robot());
  }
  double fastest = 0.0, fastest_turn = 0.0, hardest = 0.0, hardest_turn = 0.0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    fastest = std::max(fastest, std::abs(states[i].v));
    fastest_turn = std::max(fastest_turn, std::abs(states[i].omega));
    if (i >= static_cast<std::size_t>(window)) {
      const RobotState& earlier = states[i - static_cast<std::size_t>(window)];
      hardest = std::max(hardest, std::abs(states[i].v - earlier.v) / 0.1);
      hardest_turn = std::max(hardest_turn, std::abs(states[i].omega - earlier.omega) / 0.1);
    }
  }
  const worlds::Robot& robot = world.robot;
  EXPECT_NEAR(fastest, robot.max_speed, 0.01 * robot.max_speed);
  EXPECT_NEAR(fastest_turn, robot.max_turn_rate, 0.01 * robot.max_turn_rate);
  EXPECT_NEAR(hardest, robot.max_acceleration, 0.05 * robot.max_acceleration);
  EXPECT_NEAR(hardest_turn, robot.max_turn_acceleration, 0.05 * robot.max_turn_acceleration);
}

// The same drive 100 km from the origin, where neighbouring doubles are 1.5e-11 m apart. The only difference is
// rounding, and its growth over 10 s of driving.
TEST(Motion, IsAsAccurateFarFromTheOrigin) {
  worlds::World here, there;
  there.robot.start.position = {1e5, -1e5};
  const auto near = make_simulator(here), far = make_simulator(there);
  drive_for(*near, here, 10.0, {0.8, 0.3});
  drive_for(*far, there, 10.0, {0.8, 0.3});
  const RobotState a = near->robot();
  const RobotState b = far->robot();
  EXPECT_LT((b.position - there.robot.start.position - a.position).norm(), 1e-5);
  EXPECT_NEAR(a.heading, b.heading, 1e-5);
  EXPECT_NEAR(a.left_wheel, b.left_wheel, 1e-4);
}

TEST(Motion, StartsWhereTheWorldSays) {
  worlds::World world;
  world.robot.start = {{3.0, -2.0}, 2.5};
  const RobotState state = make_simulator(world)->robot();
  EXPECT_EQ(state.t, 0.0);
  EXPECT_NEAR(state.position.x(), 3.0, 1e-14);
  EXPECT_NEAR(state.position.y(), -2.0, 1e-14);
  EXPECT_NEAR(state.heading, 2.5, 1e-14);
  EXPECT_EQ(state.left_wheel, 0.0);
  EXPECT_EQ(state.right_wheel, 0.0);
}

TEST(Motion, RefusesWhatMakesNoSense) {
  const auto refused = [](auto change) {
    worlds::World world;
    change(world);
    EXPECT_THROW(make_simulator(world), std::invalid_argument);
  };
  refused([](worlds::World& w) { w.physics.step_rate = 0; });
  refused([](worlds::World& w) { w.robot.mass = 0.5; });
  refused([](worlds::World& w) { w.robot.wheel_radius = -0.1; });
  refused([](worlds::World& w) { w.robot.max_speed = std::numeric_limits<double>::quiet_NaN(); });
  refused([](worlds::World& w) { w.landmarks.push_back({{1, 1}, 0.0}); });
  refused([](worlds::World& w) { w.boxes.push_back({{{1, 1}, 0.0}, {0.0, 1.0}, 1.0}); });
  refused([](worlds::World& w) { w.walls.push_back({{{1, 1}}, 0.1, 1.0, false}); });
  refused([](worlds::World& w) { w.walls.push_back({{{1, 1}, {1, 1}}, 0.1, 1.0, false}); });
  const auto simulator = make_simulator({});
  EXPECT_THROW(simulator->step({std::numeric_limits<double>::quiet_NaN(), 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sim
