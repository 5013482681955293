// Aggregates the runs of a sweep by setting and estimator: means, medians and paired differences.
// Definitions: docs/sweeps.md.
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
  std::size_t pairs = 0;               // [-] runs in which the baseline has the score too
  std::optional<Estimate> difference;  // mean over the pairs: its value minus the baseline's
};

struct EstimatorStatistics {
  std::string name;
  std::size_t runs = 0;    // [-] runs that it finished
  std::size_t failed = 0;  // [-] runs in which the estimator or the whole run failed
  std::vector<ScoreStatistics> scores;

  const ScoreStatistics* find(const std::string& score) const;  // null: no run has this score
};

/// The statistics of one setting, by estimator.
struct SettingStatistics {
  std::vector<std::string> values;  // values of the axes
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

/// Aggregates the runs of one setting. `runs` are those that did not fail, in the order of the seeds;
/// `failed` is the number of the others.
std::vector<EstimatorStatistics> aggregate_runs(std::span<const std::vector<EstimatorRow>> runs,
                                                std::size_t failed, const std::string& baseline);

std::string to_json(const Aggregate& aggregate);

/// A row for each setting, estimator and score.
std::string to_csv(const Aggregate& aggregate);

/// The most important scores as a table.
std::vector<TextRow> aggregate_table(const Aggregate& aggregate);

/// The same as text, with the failures below.
std::string aggregate_board(const Aggregate& aggregate);

}  // namespace harness
