// Which estimators a log whose observations do not name their landmarks can be given to.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/stream/log_description.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

struct AbleEstimators {
  std::vector<worlds::EstimatorChoice> choices;
  std::vector<std::string> notes;  // one for each estimator that was changed or left out
};

/// The estimators that can run on this log. If its observations name no landmark, an estimator that can find
/// out by itself does so, and one that cannot is left out. Throws BadInput if a type is not registered.
AbleEstimators able_estimators(const seif::Registry& registry,
                               std::span<const worlds::EstimatorChoice> choices, const LogDescription& log);

/// What to type instead, given the names of the types that can run without names.
using Remedy = std::function<std::string(const std::vector<std::string>& types)>;

/// The same, but throws BadInput, with the remedy, if all estimators were left out.
AbleEstimators some_able_estimators(const seif::Registry& registry,
                                    std::span<const worlds::EstimatorChoice> choices,
                                    const LogDescription& log, const Remedy& remedy);

/// The same for a world.
AbleEstimators some_able_estimators(const seif::Registry& registry, const worlds::World& world,
                                    const LogDescription& log);

/// Throws BadInput if the estimator that steers was left out.
void check_steering(const worlds::World& world, const AbleEstimators& able);

}  // namespace harness
