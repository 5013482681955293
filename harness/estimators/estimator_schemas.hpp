// The options of the registered estimators, as the world loader wants to know them.
#pragma once

#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

worlds::EstimatorSchemas estimator_schemas(const seif::Registry& registry);

}  // namespace harness
