#include "harness/sweep/aggregate.hpp"

#include <algorithm>
#include <utility>

namespace harness {

namespace {

using Runs = std::span<const std::vector<EstimatorRow>>;

std::vector<std::string> names_of(Runs runs) {
  std::vector<std::string> names;
  for (const std::vector<EstimatorRow>& run : runs) {
    for (const EstimatorRow& row : run) {
      if (std::ranges::find(names, row.estimator) == names.end()) names.push_back(row.estimator);
    }
  }
  return names;
}

/// The row of an estimator in a run; null if it did not finish the run.
const EstimatorRow* finished(const std::vector<EstimatorRow>& run, const std::string& name) {
  const auto row = std::ranges::find(run, name, &EstimatorRow::estimator);
  return row == run.end() || !row->failure.empty() ? nullptr : &*row;
}

std::optional<double> number_of(const EstimatorRow* row, const std::string& score) {
  if (row == nullptr) return std::nullopt;
  const auto value = std::ranges::find(row->scores, score, &NamedValue::name);
  return value == row->scores.end() ? std::nullopt : value->number;
}

/// The names of all scores of an estimator, in the order in which they first occur.
std::vector<std::string> scores_of(Runs runs, const std::string& estimator) {
  std::vector<std::string> names;
  for (const std::vector<EstimatorRow>& run : runs) {
    const EstimatorRow* row = finished(run, estimator);
    if (row == nullptr) continue;
    for (const NamedValue& value : row->scores) {
      if (std::ranges::find(names, value.name) == names.end()) names.push_back(value.name);
    }
  }
  return names;
}

/// Empty if the score is not a number in any run.
std::optional<ScoreStatistics> statistics_of(Runs runs, const std::string& estimator,
                                             const std::string& baseline, const std::string& score) {
  std::vector<double> values;
  std::vector<double> differences;
  for (const std::vector<EstimatorRow>& run : runs) {
    const std::optional<double> value = number_of(finished(run, estimator), score);
    if (!value) continue;
    values.push_back(*value);
    const std::optional<double> other = number_of(finished(run, baseline), score);
    if (other && estimator != baseline) differences.push_back(*value - *other);
  }
  const std::optional<Estimate> mean = mean_of_positive(values);
  if (!mean) return std::nullopt;
  return ScoreStatistics{
      score, values.size(), *mean, *median_of(values), differences.size(), mean_of(differences)};
}

}  // namespace

const ScoreStatistics* EstimatorStatistics::find(const std::string& score) const {
  const auto found = std::ranges::find(scores, score, &ScoreStatistics::name);
  return found == scores.end() ? nullptr : &*found;
}

std::vector<EstimatorStatistics> aggregate_runs(Runs runs, std::size_t failed, const std::string& baseline) {
  std::vector<EstimatorStatistics> all;
  for (const std::string& name : names_of(runs)) {
    EstimatorStatistics estimator;
    estimator.name = name;
    estimator.failed = failed;
    for (const std::vector<EstimatorRow>& run : runs)
      ++(finished(run, name) == nullptr ? estimator.failed : estimator.runs);
    for (const std::string& score : scores_of(runs, name)) {
      if (auto statistics = statistics_of(runs, name, baseline, score))
        estimator.scores.push_back(std::move(*statistics));
    }
    all.push_back(std::move(estimator));
  }
  return all;
}

}  // namespace harness
