// The options of the registered estimators and of those in plug-ins, for the world loader.
#pragma once

#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

worlds::EstimatorSchemas estimator_schemas(const seif::Registry& registry);

}  // namespace harness
