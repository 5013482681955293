// The estimators that the program knows.
#pragma once

#include "seif/registry.hpp"

namespace harness {

/// Those of seif/, and `batch`.
seif::Registry known_estimators();

}  // namespace harness
