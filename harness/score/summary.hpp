// summary.json: what came out of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/score/score_folder.hpp"

namespace harness {

struct Summary {
  std::string world;
  std::uint64_t seed = 0;
  std::string version;       // of the program
  double duration = 0.0;     // [s] from the start to the last event
  std::int64_t updates = 0;  // [-] scans
  bool interrupted = false;
  std::string trajectory_hash;
  double realtime_factor = 0.0;                                  // [-] duration over the time that it took
  double rpe_interval = 0.0;                                     // [s]
  std::vector<std::pair<std::string, std::int64_t>> log_counts;  // what the reader of a log left out, if any
  std::vector<std::pair<std::string, std::int64_t>> left_out;    // what no estimator was given, if any
  std::optional<double> left_out_t;                              // [s] when something first was
  RunScore score;
  std::vector<std::string> failures;  // one for each of score.estimators; empty: none
};

/// What stands in a summary.json, but of the scores the names of the estimators alone: the others are in the
/// folder. Throws BadInput.
Summary read_summary(const std::filesystem::path& file);

/// Values that are not available, or not finite, are null.
std::string to_json(const Summary& summary);

}  // namespace harness
