// A run with all scores of `seifbed score`. Those that need a replay there are computed during the run.
#pragma once

#include <optional>
#include <string>

#include "harness/run/prepared_run.hpp"
#include "harness/score/details.hpp"

namespace harness {

struct DetailedRun {
  RunResult result;
  std::optional<RunDetails> details = {};  // nothing of a run that ended before its time
};

/// As execute(); summary.json contains the details, too.
DetailedRun execute_in_detail(PreparedRun& run);

/// The summary, with the details where there are any.
std::string to_json(const DetailedRun& run);

}  // namespace harness
