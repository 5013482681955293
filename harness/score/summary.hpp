// summary.json: the results of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
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
  std::string error;  // why the run ended before its stream did; empty: it did not, or someone stopped it
  std::string trajectory_hash;
  double realtime_factor = 0.0;                                  // [-] simulated time over real time
  double rpe_interval = 0.0;                                     // [s]
  std::vector<std::pair<std::string, std::int64_t>> log_counts;  // what the reader of a log left out
  std::vector<std::pair<std::string, std::int64_t>> left_out;    // what no estimator was given, if anything
  std::optional<double> left_out_t;                              // [s] time of the first event in `left_out`
  std::vector<std::string> notes;  // how the estimators that ran differ from those asked for; may be empty
  RunScore score;
  std::vector<std::string> failures;  // one entry for each of `score.estimators`; empty: it did not fail
};

/// Reads a summary.json. Of the scores it reads only the names of the estimators; the scores themselves can
/// be computed from the folder. Throws BadInput.
Summary read_summary(const std::filesystem::path& file);

/// The same of a text. Throws the JSON library's exceptions too.
Summary parse_summary(std::istream& text);

/// A value that is not available or not finite is written as null.
std::string to_json(const Summary& summary);

}  // namespace harness
