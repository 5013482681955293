// What the robot is told to do, from where it is believed to be: a path, exploration, or recorded commands.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <random>

#include "harness/simulation/path_follower.hpp"
#include "seif/types.hpp"
#include "sim/simulator.hpp"
#include "worlds/world.hpp"

namespace harness {

/// Whether the robot could go straight from where it really is to p_robot_goal, `clearance` [m] away from
/// anything solid. It is what the robot sees around itself, so it is asked in the robot's frame.
using PathIsClear = std::function<bool(const Eigen::Vector2d& p_robot_goal, double clearance)>;

/// A pure function of the poses that it is given, its random engine and its own state.
class Drive {
 public:
  Drive(const worlds::Drive& drive, const worlds::Robot& robot, std::mt19937_64 random,
        PathIsClear path_is_clear);

  /// The velocity at time t [s] for a robot that is believed to be there. Times must not decrease.
  sim::Command command(double t, const seif::Pose2& T_world_robot);

 private:
  sim::Command recorded(double t);
  sim::Command explore(double t, const seif::Pose2& T_world_robot);
  bool must_give_up(double t, const seif::Pose2& T_world_robot) const;
  bool draw_goal(double t, const seif::Pose2& T_world_robot);

  worlds::Drive drive_;
  double turn_rate_;  // [rad/s] that is driven at most
  PathFollower follower_;
  std::size_t next_command_ = 0;

  // Exploration.
  std::mt19937_64 random_;
  PathIsClear path_is_clear_;
  double clearance_;        // [m] of the way to the goal; shrinks while the robot is boxed in
  double give_up_t_ = 0.0;  // [s] when the goal is given up
};

}  // namespace harness
