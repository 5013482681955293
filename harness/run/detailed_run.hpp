// Runs a world together with the details of `seifbed score`. What `seifbed score` rebuilds by a replay is
// gathered during the run.
#pragma once

#include <optional>
#include <string>

#include "harness/run/prepared_run.hpp"
#include "harness/score/details.hpp"

namespace harness {

struct DetailedRun {
  RunResult result;
  std::optional<RunDetails> details = {};  // empty if the run ended early
};

/// Runs as execute() does; summary.json also has the details.
DetailedRun execute_in_detail(PreparedRun& run);

/// The summary, with the details if there are any.
std::string to_json(const DetailedRun& run);

}  // namespace harness
