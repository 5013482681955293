// The estimator that the others are compared with.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

/// The name of the baseline: the one that was asked for, otherwise the ekf, otherwise the first. Throws
/// BadInput.
std::string choose_baseline(const std::string& asked, std::span<const worlds::EstimatorChoice> estimators);

/// Loads a world, or the settings of a log, to which `overrides` belong. If the baseline is a registered type
/// that is not among the estimators, it is added to the overrides and the world is loaded again.
worlds::LoadResult load_with_baseline(const std::string& baseline, const seif::Registry& registry,
                                      std::vector<std::string>& overrides,
                                      const std::function<worlds::LoadResult()>& load);

}  // namespace harness
