// Helpers of the motion tests: they drive a simulator, and read it like a robot with perfect encoders.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sim/simulator.hpp"

namespace sim {

inline void drive_for(Simulator& simulator, const worlds::World& world, double seconds,
                      const Command& command) {
  const auto steps = static_cast<std::int64_t>(std::lround(seconds * world.physics.step_rate));
  for (std::int64_t i = 0; i < steps; ++i) {
    simulator.step(command);
  }
}

/// The bits of a state, for exact comparison.
inline std::array<std::uint64_t, 7> bits(const RobotState& s) {
  return {std::bit_cast<std::uint64_t>(s.position.x()), std::bit_cast<std::uint64_t>(s.position.y()),
          std::bit_cast<std::uint64_t>(s.heading),      std::bit_cast<std::uint64_t>(s.left_wheel),
          std::bit_cast<std::uint64_t>(s.right_wheel),  std::bit_cast<std::uint64_t>(s.v),
          std::bit_cast<std::uint64_t>(s.omega)};
}

/// The distance of the axle's middle according to the wheels. [m]
inline double wheel_travel(const RobotState& state, const worlds::Robot& robot) {
  return 0.5 * (state.left_wheel + state.right_wheel) * robot.wheel_radius;
}

/// The turn according to the wheels. [rad]
inline double wheel_turn(const RobotState& state, const worlds::Robot& robot) {
  return (state.right_wheel - state.left_wheel) * robot.wheel_radius / robot.track;
}

}  // namespace sim
