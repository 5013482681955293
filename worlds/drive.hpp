// What the robot is told to do.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace worlds {

enum class DriveMode { hold, waypoints, loop, serpentine, explore, commands };

/// A velocity command that holds from its time until the next one's.
struct VelocityCommand {
  double t = 0.0;      // [s]
  double v = 0.0;      // [m/s]
  double omega = 0.0;  // [rad/s]
};

struct Drive {
  DriveMode mode = DriveMode::hold;
  std::string pose_from = "truth";        // whose pose steers: truth, odometry, or an estimator's name
  double speed = 0.6;                     // [m/s] cruising
  double lookahead = 0.6;                 // [m] of the pure pursuit
  std::vector<Eigen::Vector2d> path;      // waypoints, loop and serpentine: the polyline to follow [m]
  bool closed = false;                    // the path is driven round and round
  double clearance = 0.5;                 // [m] explore: from the robot's centre to anything solid
  std::vector<VelocityCommand> commands;  // commands: in the order of time
  std::string commands_file;              // commands: where they were read from, resolved
};

}  // namespace worlds
