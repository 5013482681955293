// From what the robot is told to what its wheels are told.
#pragma once

#include "sim/simulator.hpp"
#include "worlds/world.hpp"

namespace sim {

/// Throws std::invalid_argument for a wheel radius, a track or a limit of speed or acceleration that is not
/// positive.
void check_drive(const worlds::Robot& robot);

/// Throws std::invalid_argument for a place that is not finite.
void check_place(const worlds::Placement& T_world_robot);

/// What a step of dt [s] makes of `wanted` after `previous`: speed and turn rate within their limits, and
/// neither changed by more than its acceleration allows. Throws std::invalid_argument for one that is not
/// finite.
Command limited(const Command& wanted, const Command& previous, const worlds::Robot& robot, double dt);

/// How fast the wheels turn when they roll without slip. [rad/s]
struct WheelSpeeds {
  double left = 0.0;
  double right = 0.0;
};
WheelSpeeds wheel_speeds(const Command& command, const worlds::Robot& robot);

}  // namespace sim
