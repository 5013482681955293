// One run, live or replayed, from the first event to the summary.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/run/live_loop.hpp"
#include "harness/score/summary.hpp"

namespace harness {

struct RunPlan {
  std::filesystem::path folder;  // must exist, and hold nothing but the caller's files
  std::string name;              // name of the world or log
  std::uint64_t seed = 0;
  worlds::Scoring scoring;
  std::optional<double> end_t;          // [s] end of the stream; empty: not known
  bool quiet = false;                   // show no progress
  std::vector<std::string> notes = {};  // for the summary
  std::vector<OptionChange> option_changes = {};
};

struct RunResult {
  Summary summary;         // of what was run, even after an error; interrupted: by the user
  std::string error;       // why the run ended early; empty: it did not
  bool bad_input = false;  // the error is in an input file; what came before it was run
  bool is_void = false;    // the input file was refused before its first scan
};

/// Runs the estimators on the stream, records, scores, and writes summary.json. SIGINT and SIGTERM end the
/// run and it is still scored. `follower`, if there is one, is told each event after it was recorded. Throws
/// std::system_error if the run cannot be recorded.
RunResult execute(Stream& stream, const LogDescription& log, Believers& believers, const RunPlan& plan,
                  RunListener* follower = nullptr);

/// 0: success; 1: the run or an estimator failed; 2: bad input; 130: interrupted.
int exit_code(const RunResult& result);

}  // namespace harness
