// Many runs on several threads. They share nothing, so each gives the same result as alone.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/comparison/comparison.hpp"

namespace harness {

/// A run to be executed. If it throws, the message becomes the error of its result.
struct PlannedRun {
  std::string name;
  std::function<DetailedRun()> run;
};

struct FinishedRuns {
  std::vector<ComparedRun> runs;  // in the order of the plan
  bool interrupted = false;       // if true, runs that were not completed are missing
};

/// Executes all runs. SIGINT and SIGTERM interrupt them.
FinishedRuns execute_all(const std::vector<PlannedRun>& planned, int jobs, bool quiet);

}  // namespace harness
