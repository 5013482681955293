// Worlds of one density and any number of landmarks, each with a round that shows all of them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace harness {

enum class StressPattern {
  serpentine,  // anywhere in a rectangle, which is driven in lanes, round and round
  ring,        // on both sides of a circle, which is driven round and round
  forest,      // the same, but the measured part explores
};

inline constexpr std::array<std::string_view, 3> stress_pattern_names = {"serpentine", "ring", "forest"};

struct StressWorldSpec {
  StressPattern pattern = StressPattern::serpentine;
  std::int64_t landmarks = 1000;  // [-]
  double density = 0.1;           // [1/m^2]
  std::uint64_t seed = 1;
  std::vector<std::string> estimators;
};

/// Corners of the closed path that brings every landmark into view once. Lanes begin in the middle of the
/// rectangle, so that a second round begins in the midst of the map. [m]
std::vector<Eigen::Vector2d> stress_round(const StressWorldSpec& spec);

/// The world file.
std::string stress_world(const StressWorldSpec& spec);

}  // namespace harness
