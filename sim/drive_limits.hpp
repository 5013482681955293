// Applies the limits of the robot to a command, and computes the wheel speeds.
#pragma once

#include "sim/simulator.hpp"
#include "worlds/world.hpp"

namespace sim {

/// Throws std::invalid_argument if a wheel radius, a track or a limit of speed or acceleration is not positive.
void check_drive(const worlds::Robot& robot);

/// Throws std::invalid_argument if the place is not finite.
void check_place(const worlds::Placement& T_world_robot);

/// The command that the robot follows in a step of dt [s] if it is told `wanted` and followed `previous`
/// before: speed and turn rate within their limits, and both changed by no more than their acceleration limits
/// allow. Throws std::invalid_argument if `wanted` is not finite.
Command limited(const Command& wanted, const Command& previous, const worlds::Robot& robot, double dt);

/// The speeds of the wheels when they roll without slip. [rad/s]
struct WheelSpeeds {
  double left = 0.0;
  double right = 0.0;
};
WheelSpeeds wheel_speeds(const Command& command, const worlds::Robot& robot);

}  // namespace sim
