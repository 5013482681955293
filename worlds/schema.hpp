// The JSON Schema of world files, for editors. It is made from the description that the loader uses, too.
#pragma once

#include <string>

#include "worlds/load.hpp"

namespace worlds {

/// JSON Schema, draft 7, as text.
std::string json_schema(const EstimatorSchemas& estimators);

}  // namespace worlds
