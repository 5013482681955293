// Many runs on several threads. They share nothing, so each gives the same result as alone.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/comparison/comparison.hpp"

namespace harness {

/// A run to be done. An exception becomes the error of its result.
struct PlannedRun {
  std::string name;
  std::function<DetailedRun()> run;
};

struct FinishedRuns {
  std::vector<ComparedRun> runs;  // in the order of the plan
  bool interrupted = false;       // then those that had not come to an end are missing
};

/// SIGINT and SIGTERM end it.
FinishedRuns execute_all(const std::vector<PlannedRun>& planned, int jobs, bool quiet);

}  // namespace harness
