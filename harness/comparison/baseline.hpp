// The estimator that others are compared with.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

/// Chooses the baseline by name among the estimators; empty: the ekf, or the first. Throws BadInput.
std::string choose_baseline(const std::string& asked, std::span<const worlds::EstimatorChoice> estimators);

/// Loads a world or the settings of a log, which `overrides` belong to. If the baseline is a registered type
/// and not among the estimators, it is added to the overrides, and loaded again.
worlds::LoadResult load_with_baseline(const std::string& baseline, const seif::Registry& registry,
                                      std::vector<std::string>& overrides,
                                      const std::function<worlds::LoadResult()>& load);

}  // namespace harness
