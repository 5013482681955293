// How the time of each stage grows with the number of landmarks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/statistics/statistics.hpp"
#include "harness/stress/stress.hpp"

namespace harness {

/// The median time of a stage against the number of landmarks.
struct StageScaling {
  std::string name;
  std::vector<double> landmarks;  // [-]
  std::vector<double> us;         // p50
  /// The slope of log time against log landmarks: 0 is constant time, 2 is a dense filter.
  std::optional<Estimate> slope;
};

/// Physics step, scan, rest, each estimator under its name, and the simulated second as a whole.
std::vector<StageScaling> scaling_of(const std::vector<StressRow>& rows);

}  // namespace harness
