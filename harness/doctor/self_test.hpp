// Whether this build does on this machine what it was made for. A few seconds.
#pragma once

#include <vector>

#include "harness/doctor/diagnosis.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Physics, sensing, estimation, recording and rendering, each held against what must come of it.
std::vector<Finding> test_self(const seif::Registry& registry);

}  // namespace harness
