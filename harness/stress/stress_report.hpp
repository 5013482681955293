// A stress test as tables and as JSON.
#pragma once

#include <string>

#include "harness/stress/stress.hpp"

namespace harness {

std::string stress_tables(const StressPlan& plan, const StressResult& result);

/// Values that are not available are null.
std::string to_json(const StressPlan& plan, const StressResult& result);

}  // namespace harness
