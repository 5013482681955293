#include "harness/simulation/drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "sensors/random_stream.hpp"

namespace harness {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double dt = 0.05;  // [s] between commands

bool everything_is_clear(const Eigen::Vector2d&, double) { return true; }

/// A robot that follows its command at once.
struct KinematicRobot {
  double t = 0.0;
  seif::Pose2 pose;
  sim::Command last;

  void obey(Drive& drive) {
    last = drive.command(t, pose);
    const seif::Pose2 half{0.0, 0.0, 0.5 * last.omega * dt};
    pose = pose * half * seif::Pose2{last.v * dt, 0.0, 0.0} * half;
    t += dt;
  }
  Eigen::Vector2d position() const { return {pose.x, pose.y}; }
};

Drive make_drive(const worlds::Drive& drive, const worlds::Robot& robot = {}) {
  return {drive, robot, sensors::random_stream(1, "drive"), everything_is_clear};
}

worlds::Drive along(std::vector<Eigen::Vector2d> path, bool closed = false) {
  worlds::Drive drive;
  drive.mode = closed ? worlds::DriveMode::loop : worlds::DriveMode::waypoints;
  drive.path = std::move(path);
  drive.closed = closed;
  return drive;
}

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double share = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + share * (b - a) - p).norm();
}

double distance_to_path(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& path) {
  double smallest = distance_to_segment(p, path[0], path[1]);
  for (std::size_t i = 1; i + 1 < path.size(); ++i)
    smallest = std::min(smallest, distance_to_segment(p, path[i], path[i + 1]));
  return smallest;
}

TEST(Drive, FollowsWaypointsAndStopsAtTheLast) {
  const std::vector<Eigen::Vector2d> path = {{5, 0}, {5, 5}, {0, 5}};
  Drive drive = make_drive(along(path));
  KinematicRobot robot;
  std::vector<Eigen::Vector2d> whole = path;
  whole.insert(whole.begin(), {0, 0});
  double farthest = 0.0;
  for (int i = 0; i < 1200; ++i) {
    robot.obey(drive);
    farthest = std::max(farthest, distance_to_path(robot.position(), whole));
  }
  // Pure pursuit cuts a corner by less than the lookahead.
  EXPECT_LT(farthest, 0.6);
  EXPECT_LT((robot.position() - path.back()).norm(), 0.1);
  EXPECT_EQ(robot.last.v, 0.0);
  EXPECT_EQ(robot.last.omega, 0.0);
}

TEST(Drive, GoesRoundAClosedPathAgainAndAgain) {
  const std::vector<Eigen::Vector2d> square = {{3, -3}, {3, 3}, {-3, 3}, {-3, -3}};
  worlds::Robot at;
  at.start.position = {3, 0};
  Drive drive = make_drive(along(square, true), at);
  KinematicRobot robot;
  robot.pose = {3, 0, pi / 2};
  double turned = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double before = std::atan2(robot.pose.y, robot.pose.x);
    robot.obey(drive);
    turned += seif::wrap_angle(std::atan2(robot.pose.y, robot.pose.x) - before);
  }
  // 200 s at 0.6 m/s are 120 m, five rounds, apart from the effect of the corners.
  EXPECT_GT(turned, 4.5 * 2.0 * pi);
}

TEST(Drive, TurnsOnTheSpotWhereThePathTurnsBack) {
  Drive drive = make_drive(along({{4, 0}, {0, 0}}));
  KinematicRobot robot;
  double farthest = 0.0;
  for (int i = 0; i < 800; ++i) {
    robot.obey(drive);
    farthest = std::max(farthest, robot.pose.x);
    EXPECT_LT(std::abs(robot.pose.y), 0.2);
  }
  EXPECT_NEAR(farthest, 4.0, 0.1);
  EXPECT_NEAR(robot.pose.x, 0.0, 0.1);
}

TEST(Drive, KeepsTheLimitsInSharpTurns) {
  worlds::Robot limits;
  limits.max_turn_rate = 0.5;
  limits.max_speed = 0.4;
  Drive drive = make_drive(along({{1, 0}, {1, 1}, {0, 1}, {0.5, 3}}), limits);
  KinematicRobot robot;
  for (int i = 0; i < 1000; ++i) {
    robot.obey(drive);
    EXPECT_LE(std::abs(robot.last.omega), 0.5);
    EXPECT_LE(robot.last.v, 0.4);
    EXPECT_GE(robot.last.v, 0.0);
  }
}

TEST(Drive, APathOfPointsThatAreAllTheSameEnds) {
  Drive drive = make_drive(along({{1, 1}, {1, 1}, {1, 1}}, true));
  KinematicRobot robot;
  for (int i = 0; i < 10; ++i) robot.obey(drive);
  EXPECT_EQ(robot.last.v, 0.0);
}

TEST(Drive, RecordedCommandsHoldUntilTheNext) {
  worlds::Drive drive;
  drive.mode = worlds::DriveMode::commands;
  drive.commands = {{1.0, 0.5, 0.1}, {2.0, 0.2, -0.1}};
  Drive recorded = make_drive(drive);
  EXPECT_EQ(recorded.command(0.5, {}).v, 0.0);
  EXPECT_EQ(recorded.command(1.0, {}).v, 0.5);
  EXPECT_EQ(recorded.command(1.9, {}).omega, 0.1);
  EXPECT_EQ(recorded.command(100.0, {}).v, 0.2);
}

/// A room of 20 m with a pillar in the middle.
struct Room {
  const KinematicRobot* robot;

  bool operator()(const Eigen::Vector2d& p_robot_goal, double clearance) const {
    const Eigen::Vector2d goal = robot->pose * p_robot_goal;
    if ((goal.cwiseAbs().array() > 10.0 - clearance).any()) return false;
    return distance_to_segment({0, 0}, robot->position(), goal) > 1.0 + clearance;
  }
};

TEST(Drive, ExplorationKeepsClearAndGetsAround) {
  worlds::Drive options;
  options.mode = worlds::DriveMode::explore;
  KinematicRobot robot;
  robot.pose = {5, 5, 0};
  Drive drive(options, {}, sensors::random_stream(1, "drive"), Room{&robot});
  std::array<bool, 4> visited{};
  for (int i = 0; i < 12000; ++i) {
    robot.obey(drive);
    ASSERT_GT(robot.position().norm(), 1.0);
    ASSERT_LT(robot.position().cwiseAbs().maxCoeff(), 10.0);
    visited.at((robot.pose.x > 0.0 ? 1U : 0U) + (robot.pose.y > 0.0 ? 2U : 0U)) = true;
  }
  EXPECT_EQ(std::ranges::count(visited, true), 4);
}

TEST(Drive, ExplorationTurnsInPlaceWhenBoxedIn) {
  worlds::Drive options;
  options.mode = worlds::DriveMode::explore;
  Drive drive(options, {}, sensors::random_stream(1, "drive"),
              [](const Eigen::Vector2d&, double) { return false; });
  KinematicRobot robot;
  for (int i = 0; i < 100; ++i) robot.obey(drive);
  EXPECT_EQ(robot.last.v, 0.0);
  EXPECT_NE(robot.last.omega, 0.0);
}

TEST(Drive, ExplorationIsTheSameForTheSameSeed) {
  worlds::Drive options;
  options.mode = worlds::DriveMode::explore;
  const auto end_of = [&](std::uint64_t seed) {
    Drive drive(options, {}, sensors::random_stream(seed, "drive"), everything_is_clear);
    KinematicRobot robot;
    for (int i = 0; i < 1000; ++i) robot.obey(drive);
    return robot.position();
  };
  EXPECT_EQ(end_of(1), end_of(1));
  EXPECT_NE(end_of(1), end_of(2));
}

}  // namespace
}  // namespace harness
