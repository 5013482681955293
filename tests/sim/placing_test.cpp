// The robot is put at another place: all of it moves, and nothing else changes.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "driver.hpp"

namespace sim {
namespace {

using std::numbers::pi;

class Placing : public testing::TestWithParam<worlds::Engine> {
 protected:
  Placing() {
    world_.physics.engine = GetParam();
    simulator_ = make_simulator(world_);
    drive_for(*simulator_, world_, 2.0, {0.0, 0.0});  // Bullet's robot settles
  }

  worlds::World world_;
  std::unique_ptr<Simulator> simulator_;
};

INSTANTIATE_TEST_SUITE_P(Engines, Placing, testing::Values(worlds::Engine::bullet, worlds::Engine::kinematic),
                         [](const auto& engine) {
                           return engine.param == worlds::Engine::bullet ? "Bullet" : "Kinematic";
                         });

TEST_P(Placing, PutsTheRobotThereAndLeavesItsWheels) {
  drive_for(*simulator_, world_, 3.0, {0.5, 0.3});
  const RobotState before = simulator_->robot();
  simulator_->place({{-12.0, 7.0}, -2.5});
  const RobotState after = simulator_->robot();
  EXPECT_NEAR(after.position.x(), -12.0, 1e-9);
  EXPECT_NEAR(after.position.y(), 7.0, 1e-9);
  EXPECT_NEAR(after.heading, -2.5, 1e-9);
  EXPECT_EQ(after.left_wheel, before.left_wheel);
  EXPECT_EQ(after.right_wheel, before.right_wheel);
  EXPECT_EQ(after.t, before.t);
  EXPECT_NEAR(after.v, before.v, 1e-9);
  EXPECT_NEAR(after.omega, before.omega, 1e-9);
}

TEST_P(Placing, ARobotAtRestStaysWhereItIsPut) {
  simulator_->place({{4.0, -9.0}, pi / 3});
  const RobotState before = simulator_->robot();
  drive_for(*simulator_, world_, 5.0, {0.0, 0.0});
  const RobotState after = simulator_->robot();
  EXPECT_LT((after.position - before.position).norm(), 1e-3);
  EXPECT_NEAR(after.heading, pi / 3, 1e-3);
  EXPECT_NEAR(after.left_wheel, before.left_wheel, 1e-3);
}

// After the placing, the robot moves in its new direction by what its wheels roll.
TEST_P(Placing, ARobotThatDrivesGoesOn) {
  drive_for(*simulator_, world_, 3.0, {0.5, 0.0});
  simulator_->place({{0.0, 10.0}, -pi / 2});
  const double rolled = wheel_travel(simulator_->robot(), world_.robot);
  drive_for(*simulator_, world_, 4.0, {0.5, 0.0});
  const RobotState after = simulator_->robot();
  EXPECT_NEAR(after.position.x(), 0.0, 0.01);
  EXPECT_NEAR(after.position.y(), 8.0, 0.01);
  EXPECT_NEAR(after.heading, -pi / 2, 0.005);
  EXPECT_NEAR(wheel_travel(after, world_.robot) - rolled, 2.0, 0.01);
}

TEST_P(Placing, GivesTheSameBitsEachTime) {
  const auto drive = [&] {
    const auto simulator = make_simulator(world_);
    drive_for(*simulator, world_, 1.0, {0.5, 0.4});
    simulator->place({{3.0, 3.0}, 1.0});
    drive_for(*simulator, world_, 1.0, {0.5, 0.4});
    return bits(simulator->robot());
  };
  EXPECT_EQ(drive(), drive());
}

TEST_P(Placing, NowhereThrows) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(simulator_->place({{nan, 0.0}, 0.0}), std::invalid_argument);
  EXPECT_THROW(simulator_->place({{0.0, 0.0}, nan}), std::invalid_argument);
}

// Obstacles around the new place are there; those around the old place do not stop the robot.
TEST(PlacingInBullet, MeetsWhatStandsThere) {
  worlds::World world;
  world.boxes.push_back({{{11.0, 0.0}, 0.0}, {1.0, 4.0}, 1.0});
  const auto simulator = make_simulator(world);
  drive_for(*simulator, world, 1.0, {0.5, 0.0});
  simulator->place({{9.5, 0.0}, 0.0});
  drive_for(*simulator, world, 6.0, {0.5, 0.0});
  EXPECT_LT(simulator->robot().position.x(), 10.5);
  EXPECT_GT(simulator->robot().position.x(), 9.6);
}

}  // namespace
}  // namespace sim
