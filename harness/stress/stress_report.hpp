// The results of a stress test as tables and as JSON.
#pragma once

#include <string>

#include "harness/stress/stress.hpp"

namespace harness {

std::string stress_tables(const StressPlan& plan, const StressResult& result);

/// A value that is not available is null.
std::string to_json(const StressPlan& plan, const StressResult& result);

}  // namespace harness
