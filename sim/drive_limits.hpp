// From what the robot is told to what its wheels are told.
#pragma once

#include "sim/simulator.hpp"
#include "worlds/world.hpp"

namespace sim {

/// What a step of dt [s] makes of `wanted` after `previous`: speed and turn rate within their limits, and
/// neither changed by more than its acceleration allows.
Command limited(const Command& wanted, const Command& previous, const worlds::Robot& robot, double dt);

/// How fast the wheels turn when they roll without slip. [rad/s]
struct WheelSpeeds {
  double left = 0.0;
  double right = 0.0;
};
WheelSpeeds wheel_speeds(const Command& command, const worlds::Robot& robot);

}  // namespace sim
