#include "sim/drive_limits.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sim {

namespace {

double approach(double wanted, double previous, double limit, double step) {
  return std::clamp(std::clamp(wanted, -limit, limit), previous - step, previous + step);
}

}  // namespace

void check_drive(const worlds::Robot& robot) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!positive(robot.wheel_radius) || !positive(robot.track)) {
    throw std::invalid_argument("simulator: the robot's wheel radius and track must be positive");
  }
  if (!positive(robot.max_speed) || !positive(robot.max_turn_rate) || !positive(robot.max_acceleration) ||
      !positive(robot.max_turn_acceleration)) {
    throw std::invalid_argument("simulator: the robot's limits of speed and acceleration must be positive");
  }
}

void check_place(const worlds::Placement& T_world_robot) {
  if (!T_world_robot.position.allFinite() || !std::isfinite(T_world_robot.heading)) {
    throw std::invalid_argument("simulator: the robot cannot be put where nothing is finite");
  }
}

Command limited(const Command& wanted, const Command& previous, const worlds::Robot& robot, double dt) {
  if (!std::isfinite(wanted.v) || !std::isfinite(wanted.omega)) {
    throw std::invalid_argument("simulator: a velocity command is not finite");
  }
  return {approach(wanted.v, previous.v, robot.max_speed, robot.max_acceleration * dt),
          approach(wanted.omega, previous.omega, robot.max_turn_rate, robot.max_turn_acceleration * dt)};
}

WheelSpeeds wheel_speeds(const Command& command, const worlds::Robot& robot) {
  const double half_difference = 0.5 * robot.track * command.omega;
  return {(command.v - half_difference) / robot.wheel_radius,
          (command.v + half_difference) / robot.wheel_radius};
}

}  // namespace sim
