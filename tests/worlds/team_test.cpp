// The section `robots`: how it is read, what it inherits, and which teams are refused.
#include "worlds/team.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "world_files.hpp"
#include "worlds/geometry.hpp"
#include "worlds/path.hpp"

namespace worlds {
namespace {

using test::Folder;
using test::load_text;

constexpr const char* two_robots =
    "ground: {size_m: [40, 40]}\n"
    "sensors: {landmark_sensor: {max_range_m: 5, range_sd_m: 0.2}, encoders: {rate_hz: 40}}\n"
    "start_estimate: {x_sd_m: 0.3}\n"
    "estimators: {ekf: {gate: 9}}\n"
    "robots:\n"
    "  - name: ada\n"
    "    start: {x_m: -5, y_m: 1, heading_deg: 90}\n"
    "    drive: {mode: waypoints, waypoints_m: [[-5, 9], [3, 9]]}\n"
    "  - name: ben\n"
    "    start: {x_m: 5, y_m: -2}\n"
    "    drive: {mode: serpentine, min_m: [4, 4], max_m: [8, 8]}\n"
    "    sensors: {landmark_sensor: {max_range_m: 7}}\n"
    "    start_estimate: {y_sd_m: 0.1}\n"
    "    estimators: {seif: {}}\n";

TEST(Robots, HaveTheWorldsSensorsAndEstimatorsUnlessTheySayOtherwise) {
  const Folder folder;
  const LoadResult result = load_text(folder, two_robots);
  ASSERT_TRUE(result.world) << test::text_of(result.problems);
  const std::vector<World> alone = worlds_of_robots(*result.world);
  ASSERT_EQ(alone.size(), 2U);
  EXPECT_EQ(alone[0].robot.start.position, Eigen::Vector2d(-5, 1));
  EXPECT_DOUBLE_EQ(alone[0].robot.start.heading, 90 * degree);
  EXPECT_EQ(alone[0].drive.path.size(), 2U);
  EXPECT_EQ(alone[0].landmark_sensor.max_range, 5.0);
  EXPECT_EQ(alone[0].estimators.front().name, "ekf");
  EXPECT_EQ(alone[1].drive.path.size(), 6U);
  EXPECT_EQ(alone[1].landmark_sensor.max_range, 7.0);
  EXPECT_EQ(alone[1].estimators.front().name, "seif");
  EXPECT_EQ(alone[1].start_estimate.y_sd, 0.1);
  for (const World& world : alone) {
    EXPECT_EQ(world.landmark_sensor.range_sd, 0.2);
    EXPECT_EQ(world.encoders.rate, 40);
    EXPECT_EQ(world.start_estimate.x_sd, 0.3);
    EXPECT_TRUE(world.robots.empty());
  }
}

TEST(Robots, ResolveToAFileThatLoadsToTheSame) {
  const Folder folder;
  const LoadResult first = load_text(folder, two_robots);
  ASSERT_TRUE(first.world) << test::text_of(first.problems);
  const LoadResult second = load_text(folder, first.resolved);
  ASSERT_TRUE(second.world) << test::text_of(second.problems);
  EXPECT_EQ(second.resolved, first.resolved);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(second.world->robots[i].name, first.world->robots[i].name);
    EXPECT_EQ(second.world->robots[i].drive.path, first.world->robots[i].drive.path);
    EXPECT_EQ(second.world->robots[i].start.heading, first.world->robots[i].start.heading);
  }
}

TEST(Robots, FindTheirCommandsBesideTheFile) {
  const Folder folder;
  folder.write("go.csv", "t,v,omega\n0,0.5,0\n");
  const LoadResult result = load_text(folder, two_robots, {"robots.0.drive={mode: commands, file: go.csv}"});
  ASSERT_TRUE(result.world) << test::text_of(result.problems);
  EXPECT_EQ(result.world->robots[0].drive.commands.size(), 1U);
  EXPECT_EQ(result.world->robots[0].drive.commands_file, (folder.path() / "go.csv").string());
}

TEST(Robots, AllHaveTheirWayKeptClearOfLandmarks) {
  const Folder folder;
  const LoadResult result = load_text(
      folder, two_robots, {"landmarks.generators=[{type: uniform, count: 300, clear_m: {path: 1}}]"});
  ASSERT_TRUE(result.world) << test::text_of(result.problems);
  for (const World& world : worlds_of_robots(*result.world)) {
    EXPECT_EQ(world.landmarks.size(), 300U);
    for (const Segment& leg : legs(driven_path(world), false)) {
      for (const Landmark& landmark : world.landmarks)
        ASSERT_GE(distance(landmark.position, leg) - landmark.radius, 1.0 - 1e-9);
    }
  }
}

TEST(Robots, EachHasTheFaultsThatNameItOrNobody) {
  const Folder folder;
  const LoadResult result = load_text(folder, two_robots,
                                      {"faults=[{kind: silence, at_s: 1, sensor: encoders, duration_s: 2}, "
                                       "{kind: outlier, at_s: 2, size_sigma: 5, robot: ben}, "
                                       "{kind: kidnapping, at_s: 3, x_m: 0, y_m: 0, robot: ada}]"});
  ASSERT_TRUE(result.world) << test::text_of(result.problems);
  const std::vector<World> alone = worlds_of_robots(*result.world);
  ASSERT_EQ(alone[0].faults.size(), 2U);
  EXPECT_EQ(alone[0].faults[1].kind, FaultKind::kidnapping);
  ASSERT_EQ(alone[1].faults.size(), 2U);
  EXPECT_EQ(alone[1].faults[1].kind, FaultKind::outlier);
}

TEST(Robots, ThatDoNotFitAreRefusedWhereTheyStand) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"robots.1.name=ada", "two robots have the name 'ada'"},
      {"robots.1.name=a/b", "'a/b' is no name"},
      {"robots.1.start={x_m: -5.1, y_m: 1}", "the robot starts 0.100 m from 'ada'"},
      {"robots.1.start={x_m: 90, y_m: 1}", "starts off the ground"},
      {"robots.1.drive.max_m=[90, 8]", "is off the ground"},
      {"robots.1.drive.pose_from=ekf",
       "'pose_from' must be truth, odometry or one of the estimators, not 'ekf'"},
      {"robots.1.drive.speed_m_s=3", "the speed is more than robot.max_speed_m_s"},
      {"robots.1.sensors.encoders.rate_hz=7", "the rate must divide physics.step_rate_hz"},
      {"robots=[{name: a, start: {x_m: 0, y_m: 0}}]", "a team has two robots or more"},
      {"robots.0.start={x_m: 1}", "the key 'y_m' is missing"},
      {"robots.0.colour=red", "unknown key 'colour'"},
      {"drive={mode: explore}", "each has its own 'drive'"},
      {"robot.start={x_m: 1}", "each has its own 'start'"},
      {"landmarks.placed=[{x_m: 5, y_m: -2}]", "the landmark is where the robot starts"},
      {"landmarks.placed=[{x_m: -1, y_m: 9}]", "the robot's path leads through it"},
      {"faults=[{kind: outlier, at_s: 2, size_sigma: 5, robot: bem}]",
       "there is no robot 'bem' among 'robots' (did "
       "you mean 'ben'?)"},
      {"faults=[{kind: kidnapping, at_s: 3, x_m: 0, y_m: 0}]", "a kidnapping needs 'robot'"},
      {"faults=[{kind: landmark, at_s: 3, x_m: 0, y_m: 0}]",
       "nothing can appear in a world of several robots"}};
  for (const auto& [override, message] : cases) {
    const Folder folder;
    const LoadResult result = load_text(folder, two_robots, {override});
    test::expect_refused(result, message, override);
  }
}

TEST(Robots, AreThoseWhoHaveARadio) {
  const Folder folder;
  test::expect_refused(load_text(folder, "radio: {loss: 0.5}\n"), "'radio' is for 'robots'", "radio");
  EXPECT_TRUE(load_text(folder, two_robots, {"radio.loss=0.5"}).world);
}

TEST(Robots, AreNamedByFaultsOfATeamOnly) {
  const Folder folder;
  const LoadResult result =
      load_text(folder, "faults: [{kind: outlier, at_s: 2, size_sigma: 5, robot: ada}]\n");
  EXPECT_NE(test::text_of(result.problems).find("there is no robot 'ada'"), std::string::npos);
}

TEST(Robots, ThatAreTooManyAreOneProblem) {
  std::string text = "ground: {size_m: [400, 400]}\nrobots:\n";
  for (int i = 0; i < 65; ++i)
    text += "  - {name: r" + std::to_string(i) + ", start: {x_m: " + std::to_string(2 * i) + ", y_m: 0}}\n";
  const Folder folder;
  const LoadResult result = load_text(folder, text);
  ASSERT_EQ(result.problems.size(), 1U) << test::text_of(result.problems);
  EXPECT_NE(result.problems.front().message.find("at most 64"), std::string::npos);
}

}  // namespace
}  // namespace worlds
