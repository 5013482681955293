#include "harness/simulation/drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace harness {

namespace {

constexpr double share_of_limits = 0.8;  // [-] of the robot's limits; the rest is for corrections

// Exploration.
constexpr int draws = 8;                // [-] goals tried in one step, so that its work is bounded
constexpr double nearest_goal = 1.5;    // [m]
constexpr double farthest_goal = 10.0;  // [m]
constexpr double forward_sd =
    0.8;  // [rad] most goals lie ahead; otherwise the robot would wander about one place
constexpr double patience = 2.0;       // [-] times the expected duration of the way
constexpr double more_patience = 5.0;  // [s]
constexpr double share_on_the_way =
    0.7;  // [-] of the clearance: small deviations from a clear path do not make the robot give up
constexpr double shrinking = 0.97;      // [-] factor for the clearance after each step without a goal
constexpr double smallest_share = 0.2;  // [-] of the clearance

FollowerLimits limits(const worlds::Drive& drive, const worlds::Robot& robot) {
  return {.speed = std::min(drive.speed, robot.max_speed),
          .lookahead = drive.lookahead,
          .turn_rate = share_of_limits * robot.max_turn_rate,
          .deceleration = 0.5 * robot.max_acceleration};
}

}  // namespace

Drive::Drive(const worlds::Drive& drive, const worlds::Robot& robot, std::mt19937_64 random,
             PathIsClear path_is_clear)
    : drive_(drive),
      turn_rate_(share_of_limits * robot.max_turn_rate),
      follower_(limits(drive, robot)),
      random_(random),
      path_is_clear_(std::move(path_is_clear)),
      clearance_(drive.clearance) {
  if (drive_.path.empty()) return;
  std::vector<Eigen::Vector2d> path = drive_.path;
  // The way from the start to an open path is part of the path.
  if (!drive_.closed) path.insert(path.begin(), robot.start.position);
  follower_.follow(path, drive_.closed, robot.start.position);
}

sim::Command Drive::command(double t, const seif::Pose2& T_world_robot) {
  switch (drive_.mode) {
    case worlds::DriveMode::hold:
      return {};
    case worlds::DriveMode::commands:
      return recorded(t);
    case worlds::DriveMode::explore:
      return explore(t, T_world_robot);
    case worlds::DriveMode::waypoints:
    case worlds::DriveMode::loop:
    case worlds::DriveMode::serpentine:
      return follower_.command(T_world_robot);
  }
  return {};
}

/// The last command whose time has come.
sim::Command Drive::recorded(double t) {
  const std::vector<worlds::VelocityCommand>& commands = drive_.commands;
  while (next_command_ < commands.size() && commands[next_command_].t <= t) ++next_command_;
  if (next_command_ == 0) return {};
  return {commands[next_command_ - 1].v, commands[next_command_ - 1].omega};
}

sim::Command Drive::explore(double t, const seif::Pose2& T_world_robot) {
  if (!must_give_up(t, T_world_robot)) {
    const sim::Command command = follower_.command(T_world_robot);
    if (!follower_.is_finished()) return command;
    clearance_ = drive_.clearance;
  }
  if (draw_goal(t, T_world_robot)) return follower_.command(T_world_robot);
  clearance_ = std::max(shrinking * clearance_, smallest_share * drive_.clearance);
  follower_.follow({}, false, Eigen::Vector2d::Zero());
  return {0.0, 0.5 * turn_rate_};
}

bool Drive::must_give_up(double t, const seif::Pose2& T_world_robot) const {
  if (follower_.is_finished() || t > give_up_t_) return true;
  const Eigen::Vector2d p_robot_goal = inverse(T_world_robot) * follower_.end();
  return !path_is_clear_(p_robot_goal, share_on_the_way * clearance_);
}

bool Drive::draw_goal(double t, const seif::Pose2& T_world_robot) {
  std::normal_distribution<double> forward(0.0, forward_sd);
  std::uniform_real_distribution<double> anywhere(-std::numbers::pi, std::numbers::pi);
  std::uniform_real_distribution<double> away(nearest_goal, farthest_goal);
  for (int draw = 0; draw < draws; ++draw) {
    const double bearing = draw < draws / 2 ? forward(random_) : anywhere(random_);
    const double distance = away(random_);
    const Eigen::Vector2d p_robot_goal(distance * std::cos(bearing), distance * std::sin(bearing));
    if (!path_is_clear_(p_robot_goal, clearance_)) continue;
    const Eigen::Vector2d here(T_world_robot.x, T_world_robot.y);
    const Eigen::Vector2d goal = T_world_robot * p_robot_goal;
    follower_.follow(std::array{here, goal}, false, here);
    give_up_t_ = t + more_patience + patience * distance / drive_.speed;
    return true;
  }
  return false;
}

}  // namespace harness
