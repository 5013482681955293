// The results of a cell of a sweep as rows of named values, one row for each estimator.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace harness {

/// A value of a summary. The name of a nested value is joined, for instance `blocks_touched_p50`.
struct NamedValue {
  std::string name;
  std::string text;              // as in summary.json; empty: no value
  std::optional<double> number;  // empty: no value, or a text
};

/// The results of an estimator, or of `odometry`, in a run.
struct EstimatorRow {
  std::string estimator;
  std::string failure;             // empty: it did not fail
  std::vector<NamedValue> scores;  // the same at each repetition of the run
  std::vector<NamedValue> times;   // measured times
};

/// Reads the rows of a summary.json. Throws BadInput, with `file` in the message, if the text is not a
/// summary.
std::vector<EstimatorRow> rows_of(const std::string& summary, const std::string& file);

}  // namespace harness
