// Tests whether this build works on this machine. It takes a few seconds.
#pragma once

#include <vector>

#include "harness/doctor/diagnosis.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Tests physics, sensing, estimation, recording and rendering, each against known results.
std::vector<Finding> test_self(const seif::Registry& registry);

}  // namespace harness
