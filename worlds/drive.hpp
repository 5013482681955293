// The drive: how the robot is told to move.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace worlds {

enum class DriveMode { hold, waypoints, loop, serpentine, explore, commands };

/// A velocity command. It holds from its time until the time of the next one.
struct VelocityCommand {
  double t = 0.0;      // [s]
  double v = 0.0;      // [m/s]
  double omega = 0.0;  // [rad/s]
};

/// Somebody takes the wheel, or gives it back, at a time.
struct Takeover {
  double t = 0.0;         // [s]
  bool released = false;  // the drive moves the robot again
  double v = 0.0;         // [m/s]
  double omega = 0.0;     // [rad/s]
};

struct Drive {
  DriveMode mode = DriveMode::hold;
  std::string pose_from = "truth";        // the pose that steers: truth, odometry, or an estimator's name
  double speed = 0.6;                     // [m/s] cruising
  double lookahead = 0.6;                 // [m] of the pure pursuit controller
  std::vector<Eigen::Vector2d> path;      // waypoints, loop and serpentine: the polyline to follow [m]
  bool closed = false;                    // the path is driven again and again
  double clearance = 0.5;                 // [m] explore: from the robot's centre to anything solid
  std::vector<VelocityCommand> commands;  // commands: in the order of time
  std::string commands_file;              // commands: the file with its resolved path
  std::vector<Takeover> takeover;         // in the order of time
  std::string takeover_file;              // the file with its resolved path; empty: none
};

}  // namespace worlds
