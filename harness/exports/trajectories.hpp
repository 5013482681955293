// The trajectories of a run side by side.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace harness {

/// A CSV table with a row for each update: `t`, the true pose if it is known, dead reckoning, and each
/// estimator. Cells are empty after an estimator was removed from the run. Throws BadInput.
std::string trajectories_csv(const std::filesystem::path& run, std::span<const std::string> estimators);

}  // namespace harness
