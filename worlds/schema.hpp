// The JSON Schema of world files, for editors: made from the same description that the loader reads by.
#pragma once

#include <string>

#include "worlds/load.hpp"

namespace worlds {

/// JSON Schema, draft 7, as text.
std::string json_schema(const EstimatorSchemas& estimators);

}  // namespace worlds
