// One run, live or replayed, from its first event to its summary.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "harness/run/live_loop.hpp"
#include "harness/score/summary.hpp"

namespace harness {

struct RunPlan {
  std::filesystem::path folder;  // exists and is empty but for what the caller put there
  std::string name;              // of the world or log
  std::uint64_t seed = 0;
  worlds::Scoring scoring;
  std::optional<double> end_t;  // [s] where the stream ends, if that is known
  bool quiet = false;           // no progress
};

struct RunResult {
  Summary summary;         // of what there is, whatever happened
  std::string error;       // why the run ended before its time; empty: it did not
  bool bad_input = false;  // the error lies in what was read
};

/// Runs the estimators on the stream, records, scores, and writes summary.json. SIGINT and SIGTERM end the
/// run properly. `follower`, if there is one, is told of everything after it was recorded. Throws
/// std::system_error if the run cannot be recorded.
RunResult execute(Stream& stream, const LogDescription& log, Believers& believers, const RunPlan& plan,
                  RunListener* follower = nullptr);

/// 0: fine; 1: the run or an estimator failed; 2: bad input; 130: interrupted.
int exit_code(const RunResult& result);

}  // namespace harness
