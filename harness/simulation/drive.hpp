// Commands the robot by the pose that it believes: along a path, by exploration, or with recorded commands.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <random>

#include "harness/simulation/path_follower.hpp"
#include "seif/types.hpp"
#include "sim/simulator.hpp"
#include "worlds/world.hpp"

namespace harness {

/// True if the robot can drive straight from its true position to p_robot_goal, at least `clearance` [m] away
/// from obstacles. The goal is in the robot's frame, because the robot itself sees these obstacles.
using PathIsClear = std::function<bool(const Eigen::Vector2d& p_robot_goal, double clearance)>;

/// Depends only on the given poses, its random engine and its own state.
class Drive {
 public:
  Drive(const worlds::Drive& drive, const worlds::Robot& robot, std::mt19937_64 random,
        PathIsClear path_is_clear);

  /// The command at time t [s] for a robot that believes it is at T_world_robot. Times must not decrease.
  sim::Command command(double t, const seif::Pose2& T_world_robot);

 private:
  sim::Command recorded(double t);
  sim::Command explore(double t, const seif::Pose2& T_world_robot);
  bool must_give_up(double t, const seif::Pose2& T_world_robot) const;
  bool draw_goal(double t, const seif::Pose2& T_world_robot);

  worlds::Drive drive_;
  double turn_rate_;  // [rad/s] highest turn rate driven
  PathFollower follower_;
  std::size_t next_command_ = 0;

  // Exploration.
  std::mt19937_64 random_;
  PathIsClear path_is_clear_;
  double clearance_;        // [m] required along the way to the goal; it shrinks while no goal is found
  double give_up_t_ = 0.0;  // [s] time at which the goal is given up
};

}  // namespace harness
