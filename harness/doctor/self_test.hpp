// A self-test of this build on this machine, in a few seconds.
#pragma once

#include <vector>

#include "harness/doctor/diagnosis.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Physics, sensing, estimation, recording and rendering, each compared with the expected result.
std::vector<Finding> test_self(const seif::Registry& registry);

}  // namespace harness
