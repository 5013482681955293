// Several robots in one world: they collide, and hide landmarks from each other.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "driver.hpp"

namespace sim {
namespace {

using Simulators = std::vector<std::unique_ptr<Simulator>>;

worlds::World world_of(const std::vector<worlds::Placement>& starts) {
  worlds::World world;
  for (const worlds::Placement& start : starts) world.robots.emplace_back().start = start;
  return world;
}

void drive_all(Simulators& team, int steps, const std::vector<Command>& commands) {
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < team.size(); ++i) team[i]->step(commands[i]);
  }
}

TEST(TeamInBullet, RobotsThatDriveAtEachOtherStopWhereTheyTouch) {
  const worlds::World world = world_of({{{-2.0, 0.0}, 0.0}, {{2.0, 0.0}, worlds::degree * 180.0}});
  Simulators team = make_team(world);
  drive_all(team, 6 * world.physics.step_rate, {{0.5, 0.0}, {0.5, 0.0}});
  const double gap = team[1]->robot().position.x() - team[0]->robot().position.x();
  EXPECT_NEAR(gap, 2.0 * world.robot.wheel_radius, 0.01);
  EXPECT_NEAR(team[0]->robot().v, 0.0, 1e-2);
}

TEST(TeamInBullet, ARobotPushesOneThatStands) {
  const worlds::World world = world_of({{{-1.0, 0.0}, 0.0}, {{1.0, 0.0}, 0.0}});
  Simulators team = make_team(world);
  drive_all(team, 6 * world.physics.step_rate, {{0.5, 0.0}, {0.0, 0.0}});
  EXPECT_GT(team[1]->robot().position.x(), team[0]->robot().position.x() + 0.3);
  EXPECT_LT(team[0]->robot().position.x(), 1.5);  // without the other it would be at 2
}

TEST(TeamInBullet, RobotsHideWhatIsBehindThem) {
  worlds::World world = world_of({{{0.0, 0.0}, 0.0}, {{2.0, 0.0}, 0.0}});
  world.landmarks = {{{4.0, 0.0}, 0.1}, {{4.0, 3.0}, 0.1}, {{-2.0, 0.0}, 0.1}};
  const Simulators team = make_team(world);
  const auto sees = [&](std::size_t robot, int landmark) {
    return team[robot]->line_of_sight(team[robot]->robot().position, landmark);
  };
  EXPECT_FALSE(sees(0, 0));
  EXPECT_TRUE(sees(0, 1));
  EXPECT_TRUE(sees(0, 2));
  EXPECT_TRUE(sees(1, 0));
  EXPECT_FALSE(sees(1, 2));
}

TEST(TeamInBullet, WhatIsHiddenComesIntoViewWhenTheOtherLeaves) {
  worlds::World world = world_of({{{0.0, 0.0}, 0.0}, {{2.0, 0.0}, worlds::degree * 90.0}});
  world.landmarks = {{{4.0, 0.0}, 0.1}};
  Simulators team = make_team(world);
  EXPECT_FALSE(team[0]->line_of_sight({0.0, 0.0}, 0));
  drive_all(team, 3 * world.physics.step_rate, {{0.0, 0.0}, {0.5, 0.0}});
  EXPECT_TRUE(team[0]->line_of_sight({0.0, 0.0}, 0));
}

TEST(TeamInBullet, ARobotIsInTheWayOfAnother) {
  const worlds::World world = world_of({{{0.0, 0.0}, 0.0}, {{3.0, 0.0}, 0.0}});
  const Simulators team = make_team(world);
  EXPECT_FALSE(team[0]->path_is_clear({0.0, 0.0}, {6.0, 0.0}, 0.3));
  EXPECT_TRUE(team[0]->path_is_clear({0.0, 0.0}, {0.0, 6.0}, 0.3));
  EXPECT_TRUE(team[1]->path_is_clear({3.0, 0.0}, {6.0, 0.0}, 0.3));  // it does not stand in its own way
}

TEST(TeamInBullet, TheWorldMovesOnceAllHaveBeenTold) {
  const worlds::World world = world_of({{{0.0, 0.0}, 0.0}, {{3.0, 0.0}, 0.0}});
  const Simulators team = make_team(world);
  team[0]->step({1.0, 0.0});
  EXPECT_EQ(team[0]->counts().steps, 0);
  team[1]->step({1.0, 0.0});
  EXPECT_EQ(team[0]->counts().steps, 1);
  EXPECT_EQ(team[1]->robot().t, 1.0 / world.physics.step_rate);
}

TEST(TeamInBullet, RunsAgainToTheSameBits) {
  worlds::World world =
      world_of({{{-1.0, 0.05}, 0.0}, {{1.0, 0.0}, worlds::degree * 180.0}, {{0.0, 2.0}, -1.5}});
  world.landmarks = {{{0.0, -1.0}, 0.1}, {{0.3, 0.9}, 0.1}};
  Simulators once = make_team(world);
  Simulators again = make_team(world);
  const std::vector<Command> commands = {{0.6, 0.1}, {0.6, -0.2}, {0.5, 0.0}};
  for (Simulators* team : {&once, &again}) drive_all(*team, 10 * world.physics.step_rate, commands);
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(bits(once[i]->robot()), bits(again[i]->robot()));
}

// A robot is solved alone while it touches no other, so a far one changes nothing but the last bits.
TEST(TeamInBullet, ARobotFarFromTheOthersMovesAsIfAlone) {
  worlds::World world = world_of({{{0.0, 0.0}, 0.3}, {{500.0, 20.0}, 0.0}});
  world.landmarks = {{{2.0, 0.7}, 0.1}};
  Simulators team = make_team(world);
  worlds::World lone = worlds::world_of_robot(world, 0);
  const auto alone = make_simulator(lone);
  drive_all(team, 8 * world.physics.step_rate, {{0.5, 0.05}, {0.3, 0.5}});
  drive_for(*alone, lone, 8.0, {0.5, 0.05});
  EXPECT_LT((team[0]->robot().position - alone->robot().position).norm(), 1e-6);
  EXPECT_NEAR(team[0]->robot().left_wheel, alone->robot().left_wheel, 1e-6);
}

TEST(TeamInBullet, AStepExaminesOnlyWhatIsNearTheRobots) {
  worlds::World world = world_of({{{0.0, 0.0}, 0.0}, {{50.0, 0.0}, 0.0}});
  for (int i = 0; i < 2000; ++i)
    world.landmarks.push_back({{3.0 + 0.5 * (i % 100), 5.0 + 0.5 * (i / 100)}, 0.1});
  Simulators team = make_team(world);
  drive_all(team, 240, {{0.5, 0.0}, {0.5, 0.0}});
  EXPECT_LT(team[0]->counts().objects_stepped, 240 * 40);
}

TEST(TeamByKinematics, RobotsDoNotMeet) {
  worlds::World world = world_of({{{-1.0, 0.0}, 0.0}, {{1.0, 0.0}, worlds::degree * 180.0}});
  world.physics.engine = worlds::Engine::kinematic;
  Simulators team = make_team(world);
  drive_all(team, 10 * world.physics.step_rate, {{0.5, 0.0}, {0.5, 0.0}});
  EXPECT_GT(team[0]->robot().position.x(), 3.0);
  EXPECT_LT(team[1]->robot().position.x(), -3.0);
}

}  // namespace
}  // namespace sim
