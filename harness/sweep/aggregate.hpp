// The runs of a sweep by setting and estimator: means, medians and paired differences. Definitions:
// docs/sweeps.md.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/files/text_table.hpp"
#include "harness/statistics/statistics.hpp"
#include "harness/sweep/plan.hpp"
#include "harness/sweep/rows.hpp"

namespace harness {

/// One score of an estimator over the runs that have it.
struct ScoreStatistics {
  std::string name;
  std::size_t runs = 0;  // [-]
  Estimate mean;
  double median = 0.0;
  std::size_t pairs = 0;               // [-] runs that have it of the baseline too
  std::optional<Estimate> difference;  // mean over the pairs of its value less the baseline's
};

struct EstimatorStatistics {
  std::string name;
  std::size_t runs = 0;    // [-] finished
  std::size_t failed = 0;  // [-] in which it, or the run as a whole, failed
  std::vector<ScoreStatistics> scores;

  const ScoreStatistics* find(const std::string& score) const;  // null: no run has it
};

/// All runs of one setting; `failed` of them have no scores.
struct SettingStatistics {
  std::vector<std::string> values;  // of the axes
  std::vector<EstimatorStatistics> estimators;
};

struct FailedCell {
  std::size_t index = 0;
  std::string reason;
};

struct Aggregate {
  SweepPlan plan;
  std::vector<FailedCell> failed;
  std::vector<SettingStatistics> settings;
};

/// Aggregates the finished runs of one setting, in the order of the seeds. `failed`: the number of other runs.
std::vector<EstimatorStatistics> aggregate_runs(std::span<const std::vector<EstimatorRow>> runs,
                                                std::size_t failed, const std::string& baseline);

std::string to_json(const Aggregate& aggregate);

/// A row for each setting, estimator and score.
std::string to_csv(const Aggregate& aggregate);

/// The most important scores.
std::vector<TextRow> aggregate_table(const Aggregate& aggregate);

/// The same as text, with the failures below.
std::string aggregate_board(const Aggregate& aggregate);

}  // namespace harness
