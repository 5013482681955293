// The scores of each estimator in a cell of a sweep, as rows of named values.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace harness {

/// A value of a summary; nested ones have joined names, as in `blocks_touched_p50`.
struct NamedValue {
  std::string name;
  std::string text;              // as in summary.json; empty: there is none
  std::optional<double> number;  // nothing for text too
};

/// An estimator in a run, or `odometry`.
struct EstimatorRow {
  std::string estimator;
  std::string failure;             // empty: none
  std::vector<NamedValue> scores;  // the same whenever the run is repeated
  std::vector<NamedValue> times;   // what was measured with a clock
};

/// Reads the rows of a summary.json. Throws BadInput, which names `file`, if the text is not one.
std::vector<EstimatorRow> rows_of(const std::string& summary, const std::string& file);

}  // namespace harness
