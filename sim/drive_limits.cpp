#include "sim/drive_limits.hpp"

#include <algorithm>

namespace sim {

namespace {

double approach(double wanted, double previous, double limit, double step) {
  return std::clamp(std::clamp(wanted, -limit, limit), previous - step, previous + step);
}

}  // namespace

Command limited(const Command& wanted, const Command& previous, const worlds::Robot& robot, double dt) {
  return {approach(wanted.v, previous.v, robot.max_speed, robot.max_acceleration * dt),
          approach(wanted.omega, previous.omega, robot.max_turn_rate, robot.max_turn_acceleration * dt)};
}

WheelSpeeds wheel_speeds(const Command& command, const worlds::Robot& robot) {
  const double half_difference = 0.5 * robot.track * command.omega;
  return {(command.v - half_difference) / robot.wheel_radius,
          (command.v + half_difference) / robot.wheel_radius};
}

}  // namespace sim
