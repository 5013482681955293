// The reference of all keys of world files, as Markdown. It is made from the description that the loader uses.
#pragma once

#include <string>

#include "worlds/load.hpp"

namespace worlds {

/// One table for each section: key, allowed values, default, meaning. The options of estimators are left out;
/// only the names of the types are listed.
std::string key_tables(const EstimatorSchemas& estimators);

}  // namespace worlds
