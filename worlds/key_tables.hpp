// The reference of all keys of world files, as Markdown: made from the same description that the loader reads by.
#pragma once

#include <string>

#include "worlds/load.hpp"

namespace worlds {

/// One table for each section: key, what it may be, default, meaning. The options of estimators are left out:
/// only the names of the types are told.
std::string key_tables(const EstimatorSchemas& estimators);

}  // namespace worlds
