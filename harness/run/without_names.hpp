// Which estimators a log whose observations do not name their landmarks can be given to.
#pragma once

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

/// The names of the types that can run on such a log by an option of theirs.
std::vector<std::string> types_without_names(const seif::Registry& registry);

}  // namespace harness
