#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "driver.hpp"

namespace sim {
namespace {

using std::numbers::pi;

worlds::World kinematic_world() {
  worlds::World world;
  world.physics.engine = worlds::Engine::kinematic;
  return world;
}

/// Accelerations so high that the first step already has the commanded speeds.
worlds::World nimble_world() {
  worlds::World world = kinematic_world();
  world.robot.max_acceleration = 1e4;
  world.robot.max_turn_acceleration = 1e4;
  return world;
}

/// Changes all the time, and sometimes asks for more than the robot can do.
Command wild_command(int step) {
  return {1.5 * std::sin(0.013 * step), step % 500 < 100 ? 0.0 : 2.5 * std::sin(0.007 * step + 1.0)};
}

TEST(Kinematic, StartsWhereTheWorldSays) {
  worlds::World world = kinematic_world();
  world.robot.start = {{3.0, -2.0}, pi};
  const RobotState state = make_simulator(world)->robot();
  EXPECT_EQ(state.t, 0.0);
  EXPECT_EQ(state.position, Eigen::Vector2d(3.0, -2.0));
  EXPECT_NEAR(state.heading, pi, 1e-15);
  EXPECT_EQ(state.left_wheel, 0.0);
  EXPECT_EQ(state.right_wheel, 0.0);
}

TEST(Kinematic, DrivesAStraightLine) {
  worlds::World world = nimble_world();
  world.robot.start = {{-1.0, 2.0}, 0.75};
  const auto simulator = make_simulator(world);
  drive_for(*simulator, world, 10.0, {-0.8, 0.0});
  const RobotState state = simulator->robot();
  EXPECT_EQ(state.t, 10.0);
  const Eigen::Vector2d expected =
      Eigen::Vector2d(-1.0, 2.0) - 8.0 * Eigen::Vector2d(std::cos(0.75), std::sin(0.75));
  EXPECT_LT((state.position - expected).norm(), 1e-12);
  EXPECT_NEAR(state.heading, 0.75, 1e-15);
  EXPECT_NEAR(state.left_wheel, -8.0 / world.robot.wheel_radius, 1e-11);
  EXPECT_NEAR(state.right_wheel, -8.0 / world.robot.wheel_radius, 1e-11);
}

// From rest at the origin: (R sin theta, R (1 - cos theta)) with R = v / omega, for several rounds.
TEST(Kinematic, DrivesACircle) {
  const worlds::World world = nimble_world();
  for (const double omega : {0.5, -0.5, 1.5, 1e-9}) {
    const auto simulator = make_simulator(world);
    constexpr double v = 0.7;
    for (int second = 1; second <= 30; ++second) {
      drive_for(*simulator, world, 1.0, {v, omega});
      const RobotState state = simulator->robot();
      const double theta = omega * second;
      const Eigen::Vector2d expected =
          v / omega * Eigen::Vector2d(std::sin(theta), 2.0 * std::pow(std::sin(0.5 * theta), 2));
      EXPECT_LT((state.position - expected).norm(), 1e-11) << omega << ' ' << second;
      EXPECT_NEAR(std::remainder(state.heading - theta, 2.0 * pi), 0.0, 1e-11);
      EXPECT_GT(state.heading, -pi);
      EXPECT_LE(state.heading, pi);
    }
  }
}

// The distances that the wheels rolled in a step agree with the arc of the step: both wheels move around the
// same centre, each at its own radius. Checked with the positions of the wheels before and after.
TEST(Kinematic, TheWheelsRollWhatTheRobotDrives) {
  const worlds::World world = kinematic_world();
  const auto simulator = make_simulator(world);
  const auto p_world_wheel = [&](const RobotState& state, double side) -> Eigen::Vector2d {
    return state.position + side * 0.5 * world.robot.track *
                                Eigen::Vector2d(-std::sin(state.heading), std::cos(state.heading));
  };
  RobotState before = simulator->robot();
  double turned = 0.0;
  for (int i = 0; i < 5000; ++i) {
    simulator->step(wild_command(i));
    const RobotState after = simulator->robot();
    const double turn = std::remainder(after.heading - before.heading, 2.0 * pi);
    turned += turn;
    // An arc that turns by a is a/2 / sin(a/2) times as long as its chord.
    const double arc_over_chord = turn == 0.0 ? 1.0 : 0.5 * turn / std::sin(0.5 * turn);
    const Eigen::Vector2d ahead = Eigen::Rotation2Dd(before.heading + 0.5 * turn) * Eigen::Vector2d::UnitX();
    const auto rolled = [&](double side) {
      return arc_over_chord * ahead.dot(p_world_wheel(after, side) - p_world_wheel(before, side));
    };
    ASSERT_NEAR(rolled(+1.0), world.robot.wheel_radius * (after.left_wheel - before.left_wheel), 1e-13) << i;
    ASSERT_NEAR(rolled(-1.0), world.robot.wheel_radius * (after.right_wheel - before.right_wheel), 1e-13)
        << i;
    before = after;
  }
  EXPECT_NEAR(wheel_turn(before, world.robot), turned, 1e-10);
  EXPECT_GT(std::abs(before.left_wheel), 1.0);
}

TEST(Kinematic, KeepsAndReachesItsLimitsOfSpeedAndAcceleration) {
  const worlds::World world = kinematic_world();
  const worlds::Robot& robot = world.robot;
  const double step = 1.0 / world.physics.step_rate;
  const auto simulator = make_simulator(world);
  RobotState before = simulator->robot();
  double fastest = 0.0, fastest_turn = 0.0, hardest = 0.0, hardest_turn = 0.0;
  for (int i = 0; i < 12 * world.physics.step_rate; ++i) {
    const double sign = (i / (3 * world.physics.step_rate)) % 2 == 0 ? 1.0 : -1.0;
    simulator->step({sign * 100.0, sign * 100.0});
    const RobotState after = simulator->robot();
    fastest = std::max(fastest, std::abs(after.v));
    fastest_turn = std::max(fastest_turn, std::abs(after.omega));
    hardest = std::max(hardest, std::abs(after.v - before.v) / step);
    hardest_turn = std::max(hardest_turn, std::abs(after.omega - before.omega) / step);
    before = after;
  }
  EXPECT_EQ(fastest, robot.max_speed);
  EXPECT_EQ(fastest_turn, robot.max_turn_rate);
  EXPECT_NEAR(hardest, robot.max_acceleration, 1e-12);
  EXPECT_NEAR(hardest_turn, robot.max_turn_acceleration, 1e-12);
}

// On good ground and with strong motors the two engines drive almost the same way: Bullet's robot lags a
// little, because its contacts are soft.
TEST(Kinematic, DrivesWhatBulletDrivesWhereNothingSlips) {
  worlds::World world = kinematic_world();
  const auto kinematic = make_simulator(world);
  world.physics.engine = worlds::Engine::bullet;
  const auto in_bullet = make_simulator(world);
  for (const Command& command : {Command{0.8, 0.3}, Command{0.5, -0.9}, Command{0.0, 0.0}}) {
    drive_for(*kinematic, world, 3.0, command);
    drive_for(*in_bullet, world, 3.0, command);
  }
  EXPECT_GT(kinematic->robot().position.norm(), 1.0);
  EXPECT_LT((kinematic->robot().position - in_bullet->robot().position).norm(), 0.02);
  EXPECT_NEAR(kinematic->robot().heading, in_bullet->robot().heading, 0.01);
}

TEST(Kinematic, TheSameWorldGivesTheSameBits) {
  worlds::World world = kinematic_world();
  world.landmarks = {{{1, 0.5}, 0.1}, {{-3, 2}, 0.1}};
  const auto asked = make_simulator(world), left_alone = make_simulator(world);
  std::vector<int> found;
  for (int i = 0; i < 10000; ++i) {
    asked->step(wild_command(i));
    left_alone->step(wild_command(i));
    asked->landmarks_within(asked->robot().position, 8.0, found);
    ASSERT_EQ(bits(asked->robot()), bits(left_alone->robot())) << i;
  }
}

TEST(Kinematic, LandmarksHideNothingAndStopNothing) {
  worlds::World world = nimble_world();
  world.landmarks = {{{1, 0}, 0.3}, {{2, 0}, 0.3}};
  const auto simulator = make_simulator(world);
  EXPECT_TRUE(simulator->line_of_sight({0, 0}, 1));
  EXPECT_THROW(static_cast<void>(simulator->line_of_sight({0, 0}, 2)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(simulator->line_of_sight({0, 0}, -1)), std::out_of_range);
  drive_for(*simulator, world, 3.0, {1.0, 0.0});
  EXPECT_NEAR(simulator->robot().position.x(), 3.0, 1e-12);
}

// Long and short paths, thick and thin landmarks: the answer is that of the other engine.
TEST(Kinematic, APathIsClearWhereBulletSaysSo) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-30.0, 30.0), size(0.02, 4.0);
  worlds::World world = kinematic_world();
  world.landmark_sensor.max_range = 3.0;
  for (int i = 0; i < 30; ++i) world.landmarks.push_back({{place(random), place(random)}, size(random)});
  const auto kinematic = make_simulator(world);
  world.physics.engine = worlds::Engine::bullet;
  const auto in_bullet = make_simulator(world);
  int clear = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Eigen::Vector2d from(place(random), place(random));
    const Eigen::Vector2d to =
        trial % 2 == 0 ? Eigen::Vector2d(place(random), place(random))
                       : Eigen::Vector2d(from + 0.1 * Eigen::Vector2d(place(random), place(random)));
    const bool is_clear = kinematic->path_is_clear(from, to, 0.5);
    EXPECT_EQ(is_clear, in_bullet->path_is_clear(from, to, 0.5)) << trial;
    clear += is_clear ? 1 : 0;
  }
  EXPECT_GT(clear, 50);
  EXPECT_LT(clear, 350);
}

TEST(Kinematic, AScanAmongAMillionLandmarksLooksAtThoseNearby) {
  worlds::World world = kinematic_world();
  for (int i = 0; i < 1000; ++i) {
    for (int k = 0; k < 1000; ++k) world.landmarks.push_back({{4.0 * (i - 500), 4.0 * (k - 500)}, 0.1});
  }
  const auto simulator = make_simulator(world);
  std::vector<int> found;
  constexpr int scans = 100;
  for (int i = 0; i < scans; ++i) {
    drive_for(*simulator, world, 0.2, {1.0, 0.1});
    simulator->landmarks_within(simulator->robot().position, 8.0, found);
    EXPECT_GE(found.size(), 9U);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  }
  EXPECT_EQ(simulator->counts().steps, scans * 48);
  // Nine cells of 8 m hold 36 landmarks at one in 16 m^2.
  EXPECT_LT(simulator->counts().candidates, scans * 2 * 36);
  EXPECT_GE(simulator->counts().candidates, scans * 9);
}

TEST(Kinematic, RefusesWhatItCannotWorkWith) {
  const auto refused = [](auto change) {
    worlds::World world = kinematic_world();
    change(world);
    EXPECT_THROW(make_simulator(world), std::invalid_argument);
  };
  refused([](worlds::World& w) { w.physics.step_rate = 0; });
  refused([](worlds::World& w) { w.robot.wheel_radius = -0.1; });
  refused([](worlds::World& w) { w.robot.max_turn_rate = std::numeric_limits<double>::quiet_NaN(); });
  refused([](worlds::World& w) { w.boxes.push_back({{{5, 5}, 0.0}, {1.0, 1.0}, 1.0}); });
  refused([](worlds::World& w) { w.walls.push_back({{{5, 5}, {6, 6}}, 0.1, 1.0, false}); });
  refused([](worlds::World& w) { w.physics.patches = {{{0, 0}, {4, 4}, 0.1}}; });
  const auto simulator = make_simulator(kinematic_world());
  EXPECT_THROW(simulator->step({std::numeric_limits<double>::infinity(), 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sim
