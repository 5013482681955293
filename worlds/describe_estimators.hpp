// The description of the estimators that run.
#pragma once

#include <string_view>
#include <vector>

#include "worlds/estimator_choice.hpp"
#include "worlds/fields.hpp"
#include "worlds/load.hpp"

namespace worlds {

/// Adds them to `choices`, in the order of the file.
void describe_estimators(Fields& fields, std::vector<EstimatorChoice>& choices,
                         const EstimatorSchemas& schemas, std::string_view help);

}  // namespace worlds
