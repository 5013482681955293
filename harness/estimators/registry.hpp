// The estimators that the program knows.
#pragma once

#include <string>
#include <string_view>

#include "harness/files/bad_input.hpp"
#include "seif/registry.hpp"

namespace harness {

/// The estimators of seif/, `batch` and `mrpt_ekf`.
seif::Registry known_estimators();

/// What to throw where an option of the command line names an estimator that does not exist.
BadInput no_such_estimator(const seif::Registry& registry, std::string_view option, const std::string& name);

}  // namespace harness
