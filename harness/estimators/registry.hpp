// The estimators that the program knows.
#pragma once

#include "seif/registry.hpp"

namespace harness {

/// The estimators of seif/, `batch` and `mrpt_ekf`.
seif::Registry known_estimators();

}  // namespace harness
