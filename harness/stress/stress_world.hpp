// Worlds of the same density with any number of landmarks. Each has a closed path that shows all landmarks.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace harness {

enum class StressPattern {
  serpentine,  // in a rectangle; the robot drives its lanes again and again
  ring,        // on both sides of a circle; the robot drives round and round
  forest,      // as serpentine, but the robot explores in the measured part
};

inline constexpr std::array<std::string_view, 3> stress_pattern_names = {"serpentine", "ring", "forest"};

struct StressWorldSpec {
  StressPattern pattern = StressPattern::serpentine;
  std::int64_t landmarks = 1000;  // [-]
  double density = 0.1;           // [1/m^2]
  std::uint64_t seed = 1;
  std::vector<std::string> estimators;
};

/// The corners of the closed path that brings every landmark into view. It starts in the middle of the
/// rectangle, so a second round starts in the middle of the map. [m]
std::vector<Eigen::Vector2d> stress_round(const StressWorldSpec& spec);

/// The text of the world file.
std::string stress_world(const StressWorldSpec& spec);

}  // namespace harness
