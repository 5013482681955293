// Things are put into a world that is already moving: they are there from then on, and nothing else changes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "driver.hpp"

namespace sim {
namespace {

using Indices = std::vector<int>;

Indices landmarks_near(const Simulator& simulator, const Eigen::Vector2d& p, double radius) {
  Indices found;
  simulator.landmarks_within(p, radius, found);
  return found;
}

worlds::Wall wall_across(double x) { return {{{x, -3.0}, {x, 3.0}}, 0.1, 1.0, false}; }

/// Two landmarks and, in Bullet, a box and a wall of two segments, all far from the robot.
worlds::World furnished(worlds::Engine engine) {
  worlds::World world;
  world.physics.engine = engine;
  world.landmarks = {{{5.0, 8.0}, 0.1}, {{-5.0, 8.0}, 0.2}};
  if (engine == worlds::Engine::kinematic) return world;
  world.boxes.push_back({{{0.0, -9.0}, 0.3}, {1.0, 2.0}, 1.0});
  world.walls.push_back({{{-8.0, -8.0}, {-8.0, 8.0}, {-4.0, 12.0}}, 0.2, 1.0, false});
  return world;
}

class Adding : public testing::TestWithParam<worlds::Engine> {};

INSTANTIATE_TEST_SUITE_P(Engines, Adding, testing::Values(worlds::Engine::bullet, worlds::Engine::kinematic),
                         [](const auto& engine) {
                           return engine.param == worlds::Engine::bullet ? "Bullet" : "Kinematic";
                         });

TEST_P(Adding, ALandmarkGetsTheNextIndexAndIsFoundThere) {
  const auto simulator = make_simulator(furnished(GetParam()));
  drive_for(*simulator, {}, 1.0, {0.3, 0.0});
  EXPECT_EQ(simulator->add_landmark({{9.0, 0.0}, 0.15}), 2);
  EXPECT_EQ(simulator->add_landmark({{9.0, 1.0}, 0.15}), 3);
  EXPECT_EQ(landmarks_near(*simulator, {9.0, 0.0}, 0.5), Indices{2});
  EXPECT_EQ(landmarks_near(*simulator, {9.0, 0.5}, 0.6), (Indices{2, 3}));
  EXPECT_EQ(landmarks_near(*simulator, {0.0, 0.0}, 30.0), (Indices{0, 1, 2, 3}));
  EXPECT_TRUE(simulator->line_of_sight({7.0, 1.0}, 3));
  EXPECT_THROW(static_cast<void>(simulator->line_of_sight({7.0, 1.0}, 4)), std::out_of_range);
}

TEST_P(Adding, ALandmarkIsInTheWayOfPaths) {
  const auto simulator = make_simulator(furnished(GetParam()));
  EXPECT_TRUE(simulator->path_is_clear({0.0, 3.0}, {8.0, 3.0}, 0.3));
  simulator->add_landmark({{4.0, 3.2}, 1.5});  // larger than all others
  EXPECT_FALSE(simulator->path_is_clear({0.0, 3.0}, {8.0, 3.0}, 0.3));
  EXPECT_TRUE(simulator->path_is_clear({0.0, 1.3}, {8.0, 1.3}, 0.3));
}

TEST_P(Adding, ALandmarkWhereTheRobotStandsIsRefusedAndNothingHasChanged) {
  const worlds::World world = furnished(GetParam());
  const auto simulator = make_simulator(world);
  const auto untouched = make_simulator(world);
  drive_for(*simulator, world, 1.0, {0.4, 0.2});
  drive_for(*untouched, world, 1.0, {0.4, 0.2});
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector2d p = simulator->robot().position;
  EXPECT_THROW(simulator->add_landmark({p, 0.1}), std::invalid_argument);
  EXPECT_THROW(simulator->add_landmark({p + Eigen::Vector2d(1.0, 0.0), 0.9}), std::invalid_argument);
  EXPECT_THROW(simulator->add_landmark({{nan, 0.0}, 0.1}), std::invalid_argument);
  EXPECT_THROW(simulator->add_landmark({{4.0, 4.0}, 0.0}), std::invalid_argument);
  EXPECT_EQ(landmarks_near(*simulator, p, 30.0), (Indices{0, 1}));
  drive_for(*simulator, world, 5.0, {0.4, 0.2});
  drive_for(*untouched, world, 5.0, {0.4, 0.2});
  EXPECT_EQ(bits(simulator->robot()), bits(untouched->robot()));
  EXPECT_EQ(simulator->add_landmark({{9.0, 0.0}, 0.1}), 2);  // still the next index
}

TEST_P(Adding, SomethingFarAwayLeavesTheMotionAsItIs) {
  const worlds::World world = furnished(GetParam());
  const auto simulator = make_simulator(world);
  const auto untouched = make_simulator(world);
  for (int i = 0; i < 5; ++i) {
    simulator->add_landmark({{15.0, 15.0 - i}, 0.1});
    if (GetParam() == worlds::Engine::bullet) simulator->add_wall(wall_across(-15.0 - i));
    drive_for(*simulator, world, 1.0, {0.5, 0.1 * i});
    drive_for(*untouched, world, 1.0, {0.5, 0.1 * i});
    EXPECT_EQ(bits(simulator->robot()), bits(untouched->robot())) << i;
  }
}

TEST(AddingInTheKinematicEngine, WallsAndPatchesAreRefused) {
  const auto simulator = make_simulator(furnished(worlds::Engine::kinematic));
  EXPECT_THROW(simulator->add_wall(wall_across(5.0)), std::invalid_argument);
  EXPECT_THROW(simulator->add_patch({{3.0, 3.0}, {4.0, 4.0}, 0.1}), std::invalid_argument);
}

class AddingInBullet : public testing::Test {
 protected:
  worlds::World world_ = furnished(worlds::Engine::bullet);
  std::unique_ptr<Simulator> simulator_ = make_simulator(world_);
};

// Just in front of a robot that has looked at its surroundings after one metre, and does so again after two.
TEST_F(AddingInBullet, AWallStopsTheRobotAtOnce) {
  drive_for(*simulator_, world_, 2.5, {0.5, 0.0});
  ASSERT_NEAR(simulator_->robot().position.x(), 1.1, 0.05);
  const double x = simulator_->robot().position.x() + 0.4;
  simulator_->add_wall(wall_across(x));
  drive_for(*simulator_, world_, 4.0, {0.5, 0.0});
  EXPECT_NEAR(simulator_->robot().position.x(), x - 0.05 - world_.robot.wheel_radius, 0.01);
}

TEST_F(AddingInBullet, ALandmarkStopsTheRobotAtOnce) {
  drive_for(*simulator_, world_, 2.5, {0.5, 0.0});
  const double x = simulator_->robot().position.x() + 0.5;
  simulator_->add_landmark({{x, 0.0}, 0.1});
  drive_for(*simulator_, world_, 1.0, {0.5, 0.0});
  EXPECT_LT(simulator_->robot().position.x(), x - 0.1 - world_.robot.wheel_radius + 0.01);
}

TEST_F(AddingInBullet, AWallHidesWhatIsBehindItAndALandmarkToo) {
  EXPECT_TRUE(simulator_->line_of_sight({5.0, 2.0}, 0));
  simulator_->add_wall({{{4.0, 5.0}, {6.0, 5.0}}, 0.1, 1.0, false});
  EXPECT_FALSE(simulator_->line_of_sight({5.0, 2.0}, 0));
  EXPECT_TRUE(simulator_->line_of_sight({-5.0, 2.0}, 1));
  const int new_one = simulator_->add_landmark({{-5.0, 5.0}, 0.3});
  EXPECT_FALSE(simulator_->line_of_sight({-5.0, 2.0}, 1));
  EXPECT_TRUE(simulator_->line_of_sight({-5.0, 2.0}, new_one));  // it does not hide itself
  EXPECT_FALSE(simulator_->line_of_sight({-5.0, 9.0}, new_one));
}

// Walls of several segments between the landmarks: indices of landmarks and places in the list differ.
TEST_F(AddingInBullet, LandmarksAndWallsInTurnsKeepTheirPlaces) {
  for (int i = 0; i < 4; ++i) {
    const double y = 1.0 + 2.0 * i;
    EXPECT_EQ(simulator_->add_landmark({{12.0, y}, 0.1 + 0.1 * i}), 2 + i);
    simulator_->add_wall({{{13.0, y}, {14.0, y}, {14.0, y + 0.5}}, 0.1, 1.0, false});
  }
  for (int i = 0; i < 4; ++i) {
    const double y = 1.0 + 2.0 * i;
    EXPECT_EQ(landmarks_near(*simulator_, {12.0, y}, 0.1), Indices{2 + i});
    EXPECT_TRUE(simulator_->line_of_sight({11.0, y}, 2 + i));
    EXPECT_FALSE(simulator_->line_of_sight({16.0, y}, 2 + i));
    EXPECT_FALSE(simulator_->path_is_clear({13.5, y - 0.5}, {13.5, y + 0.5}, 0.01));
    EXPECT_FALSE(simulator_->path_is_clear({13.8, y + 0.3}, {14.2, y + 0.3}, 0.01));
    const double radius = 0.1 + 0.1 * i;
    EXPECT_FALSE(simulator_->path_is_clear({12.0, y}, {11.9 - radius, y}, 0.11 + 0.0));
    EXPECT_TRUE(simulator_->path_is_clear({11.0, y}, {11.9 - radius, y}, 0.09));
  }
}

TEST_F(AddingInBullet, AWallWhereTheRobotStandsIsRefusedAsAWhole) {
  const auto untouched = make_simulator(world_);
  const auto both = [&](double seconds) {
    drive_for(*simulator_, world_, seconds, {0.3, 0.3});
    drive_for(*untouched, world_, seconds, {0.3, 0.3});
  };
  both(1.0);
  const Eigen::Vector2d p = simulator_->robot().position;
  // The first segment alone would have room; the second passes through the robot.
  const worlds::Wall through{
      {{6.0, 6.0}, p + Eigen::Vector2d(2.0, 0.0), p - Eigen::Vector2d(2.0, 0.0)}, 0.1, 1.0};
  EXPECT_THROW(simulator_->add_wall(through), std::invalid_argument);
  EXPECT_THROW(simulator_->add_wall({{{6.0, 6.0}, {7.0, 7.0}, {7.0, 7.0}}, 0.1, 1.0}), std::invalid_argument);
  EXPECT_THROW(simulator_->add_wall({{{6.0, 6.0}}, 0.1, 1.0}), std::invalid_argument);
  EXPECT_THROW(simulator_->add_wall({{{6.0, 6.0}, {7.0, 7.0}}, 0.0, 1.0}), std::invalid_argument);
  EXPECT_TRUE(simulator_->path_is_clear({6.0, 5.0}, {6.0, 7.0}, 0.1));
  both(4.0);
  EXPECT_EQ(bits(simulator_->robot()), bits(untouched->robot()));
  // The places in the list are free again: what comes next is itself.
  EXPECT_EQ(simulator_->add_landmark({{6.0, 6.0}, 0.1}), 2);
  EXPECT_TRUE(simulator_->line_of_sight({5.0, 6.0}, 2));
  EXPECT_EQ(landmarks_near(*simulator_, {6.0, 6.0}, 0.5), Indices{2});
}

TEST_F(AddingInBullet, IceLetsTheWheelsSpin) {
  world_.robot.motor_torque = 5.0;
  const auto simulator = make_simulator(world_);
  drive_for(*simulator, world_, 1.0, {0.0, 0.0});
  simulator->add_patch({{-10.0, -10.0}, {10.0, 10.0}, 0.05});
  drive_for(*simulator, world_, 1.0, {1.0, 0.0});
  const RobotState slipped = simulator->robot();
  EXPECT_GT(wheel_travel(slipped, world_.robot) - slipped.position.x(), 0.1);
  simulator->add_patch({{-10.0, -10.0}, {10.0, 10.0}, 0.9});  // the latest counts
  drive_for(*simulator, world_, 1.0, {1.0, 0.0});
  const RobotState held = simulator->robot();
  const double rolled = wheel_travel(held, world_.robot) - wheel_travel(slipped, world_.robot);
  EXPECT_NEAR(held.position.x() - slipped.position.x(), rolled, 0.2);
  EXPECT_GT(held.v, 0.95);
}

// What is there before the first step might as well have been there from the start.
TEST_F(AddingInBullet, BeforeTheFirstStepItIsAsIfItHadAlwaysBeenThere) {
  worlds::World whole = world_;
  whole.boxes.clear();
  whole.walls = {wall_across(2.0)};
  worlds::World empty = whole;
  empty.walls.clear();
  const auto from_the_start = make_simulator(whole);
  const auto added = make_simulator(empty);
  added->add_wall(whole.walls.front());
  for (int i = 0; i < 10; ++i) {
    drive_for(*from_the_start, whole, 0.5, {0.5, 0.2});
    drive_for(*added, whole, 0.5, {0.5, 0.2});
    ASSERT_EQ(bits(added->robot()), bits(from_the_start->robot())) << i;
  }
  EXPECT_LT(added->robot().position.x(), 1.9);
}

// Nothing prevents this in a world file; the robot is pushed out or stays, and everything stays finite.
TEST_F(AddingInBullet, ARobotThatIsPutIntoSomethingStaysFinite) {
  simulator_->add_wall(wall_across(3.0));
  simulator_->add_landmark({{-3.0, 0.0}, 0.3});
  for (const double x : {3.0, -3.0, 3.04, -2.8}) {
    simulator_->place({{x, 0.0}, 0.4});
    drive_for(*simulator_, world_, 2.0, {0.5, 0.3});
    const RobotState robot = simulator_->robot();
    EXPECT_TRUE(robot.position.allFinite());
    EXPECT_LT((robot.position - Eigen::Vector2d(x, 0.0)).norm(), 4.0);
  }
}

TEST_F(AddingInBullet, AHundredThingsFarAwayMakeNoStepDearer) {
  for (int i = 0; i < 100; ++i) simulator_->add_landmark({{15.0, -15.0 + 0.3 * i}, 0.1});
  drive_for(*simulator_, world_, 1.0, {0.0, 0.0});
  EXPECT_EQ(simulator_->counts().objects_stepped, 4 * simulator_->counts().steps);
}

}  // namespace
}  // namespace sim
