// A run with all that `seifbed score` tells of one. What that rebuilds by a replay is taken as the run goes.
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

/// As execute(); the details stand in summary.json too.
DetailedRun execute_in_detail(PreparedRun& run);

/// The summary, with the details where there are any.
std::string to_json(const DetailedRun& run);

}  // namespace harness
