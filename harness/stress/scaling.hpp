// How the time of each stage grows with the number of landmarks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/statistics/statistics.hpp"
#include "harness/stress/stress.hpp"

namespace harness {

/// The median time of a stage as a function of the number of landmarks.
struct StageScaling {
  std::string name;
  std::vector<double> landmarks;  // [-]
  std::vector<double> us;         // median times
  /// Slope of log time over log landmarks. 0 is constant time, 2 is that of a dense filter.
  std::optional<Estimate> slope;
};

/// The physics step, the scan, the rest, each estimator by name, and the whole simulated second.
std::vector<StageScaling> scaling_of(const std::vector<StressRow>& rows);

}  // namespace harness
