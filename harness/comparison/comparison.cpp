#include "harness/comparison/comparison.hpp"

#include <algorithm>
#include <functional>

namespace harness {

namespace {

/// A value of an estimator for each run; empty if it did not finish the run or has no such value.
using Values = std::vector<std::optional<double>>;
using Get = std::function<std::optional<double>(const EstimatorScore&)>;

std::optional<double> squared(const std::optional<double>& value) {
  return value ? std::optional(*value * *value) : std::nullopt;
}

template <class Count>
std::optional<double> real(const std::optional<Count>& count) {
  return count ? std::optional(static_cast<double>(*count)) : std::nullopt;
}

std::vector<std::string> names_of(std::span<const ComparedRun> runs) {
  std::vector<std::string> names;
  for (const ComparedRun& run : runs) {
    for (const EstimatorScore& score : run.result.summary.score.estimators) {
      if (std::ranges::find(names, score.name) == names.end()) names.push_back(score.name);
    }
  }
  return names;
}

/// The score of an estimator in a run; null if it did not finish the run.
const EstimatorScore* finished(const ComparedRun& run, const std::string& name) {
  const Summary& summary = run.result.summary;
  const auto score = std::ranges::find(summary.score.estimators, name, &EstimatorScore::name);
  if (!run.result.error.empty() || score == summary.score.estimators.end()) return nullptr;
  const auto index = static_cast<std::size_t>(score - summary.score.estimators.begin());
  return summary.failures.at(index).empty() ? &*score : nullptr;
}

/// True if the run has this estimator. A run that failed before it began counts for all estimators.
bool takes_part(const ComparedRun& run, const std::string& name) {
  const std::vector<EstimatorScore>& scores = run.result.summary.score.estimators;
  return scores.empty() || std::ranges::find(scores, name, &EstimatorScore::name) != scores.end();
}

Values collect(std::span<const ComparedRun> runs, const std::string& name, const Get& get) {
  Values values;
  for (const ComparedRun& run : runs) {
    const EstimatorScore* score = finished(run, name);
    values.push_back(score == nullptr ? std::nullopt : get(*score));
  }
  return values;
}

std::vector<double> present(const Values& values) {
  std::vector<double> result;
  for (const std::optional<double>& value : values) {
    if (value) result.push_back(*value);
  }
  return result;
}

std::optional<double> value_of(const std::optional<Estimate>& estimate) {
  return estimate ? std::optional(estimate->value) : std::nullopt;
}

/// The values of the runs that both estimators finished.
struct Pairs {
  std::vector<double> values;
  std::vector<double> baseline;
};

Pairs pairs_of(const Values& values, const Values& baseline) {
  Pairs pairs;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i] || !baseline[i]) continue;
    pairs.values.push_back(*values[i]);
    pairs.baseline.push_back(*baseline[i]);
  }
  return pairs;
}

/// The ratio for each run.
Values ratios(const Values& values, const Values& baseline) {
  Values result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] && baseline[i] && *baseline[i] > 0.0) result[i] = *values[i] / *baseline[i];
  }
  return result;
}

std::optional<double> landmark_mse(const EstimatorScore& score) { return squared(score.landmarks.rmse); }

std::optional<double> aligned(const EstimatorScore& score) { return score.landmarks.rmse_aligned; }

void compare_errors(std::span<const ComparedRun> runs, const std::string& baseline,
                    EstimatorComparison& estimator) {
  const Values mse = collect(runs, estimator.name, landmark_mse);
  estimator.landmark_mse = mean_of_positive(present(mse));
  estimator.landmark_mse_median = median_of(present(mse));
  const Pairs mse_pairs = pairs_of(mse, collect(runs, baseline, landmark_mse));
  estimator.landmark_mse_ratio = ratio_of_pairs(mse_pairs.values, mse_pairs.baseline);
  estimator.landmark_mse_ratio_of_means = ratio_of_means(mse_pairs.values, mse_pairs.baseline);
  const Values rmse = collect(runs, estimator.name, aligned);
  estimator.landmark_aligned = mean_of_positive(present(rmse));
  const Values baseline_rmse = collect(runs, baseline, aligned);
  const Pairs rmse_pairs = pairs_of(rmse, baseline_rmse);
  estimator.aligned_ratio = ratio_of_pairs(rmse_pairs.values, rmse_pairs.baseline);
  estimator.aligned_ratio_median = median_of(present(ratios(rmse, baseline_rmse)));
}

/// Adds the means of the details, over the runs that the estimator finished.
void compare_details(std::span<const ComparedRun> runs, EstimatorComparison& estimator) {
  const auto mean = [&](const std::function<std::optional<double>(const EstimatorDetails&)>& get) {
    std::vector<double> values;
    for (const ComparedRun& run : runs) {
      if (!run.details || finished(run, estimator.name) == nullptr) continue;
      const auto details =
          std::ranges::find(run.details->estimators, estimator.name, &EstimatorDetails::name);
      if (const std::optional<double> value = get(*details)) values.push_back(*value);
    }
    return mean_of_positive(values);
  };
  const auto mean_count = [&](int MapCounts::*which) {
    return value_of(mean([which](const EstimatorDetails& details) {
      return details.map ? std::optional<double>((*details.map).*which) : std::nullopt;
    }));
  };
  estimator.nees_from_robot =
      mean([](const EstimatorDetails& details) { return details.rebuilt.nees_landmark_from_robot_final; });
  estimator.nis_scan = mean([](const EstimatorDetails& details) { return details.rebuilt.scans.nis; });
  estimator.nis_scan_inside =
      value_of(mean([](const EstimatorDetails& details) { return details.rebuilt.scans.inside; }));
  estimator.landmarks_missed = value_of(mean([](const EstimatorDetails& details) {
    return details.map ? std::optional<double>(details.map->missed) : std::nullopt;
  }));
  estimator.landmarks_spurious = mean_count(&MapCounts::spurious);
  estimator.landmarks_duplicate = mean_count(&MapCounts::duplicate);
}

/// Relocations per update; empty if the run had none.
std::optional<double> relocation_rate(const ComparedRun& run, const std::string& name) {
  const EstimatorScore* score = finished(run, name);
  if (score == nullptr || score->relocations.value_or(0) == 0) return std::nullopt;
  return static_cast<double>(*score->relocations) / static_cast<double>(run.result.summary.updates);
}

void compare_losses(std::span<const ComparedRun> runs, EstimatorComparison& estimator) {
  std::vector<double> times;
  for (const ComparedRun& run : runs) {
    const EstimatorScore* score = finished(run, estimator.name);
    if (score == nullptr || score->losses.count() == 0) continue;
    estimator.losses += score->losses.count();
    estimator.relocalised += score->losses.found();
    estimator.relocalised_wrongly += score->losses.found_wrongly();
    times.push_back(score->losses.lost_s());
  }
  estimator.lost_s = value_of(mean_of(times));
}

void compare_costs(std::span<const ComparedRun> runs, EstimatorComparison& estimator) {
  const auto values = [&](const Get& get) { return present(collect(runs, estimator.name, get)); };
  estimator.links = mean_of_positive(values([](const EstimatorScore& score) { return real(score.links); }));
  const std::vector<double> most = values([](const EstimatorScore& score) { return real(score.links_max); });
  if (!most.empty()) estimator.links_max = std::ranges::max(most);
  Values rates;
  for (const ComparedRun& run : runs) rates.push_back(relocation_rate(run, estimator.name));
  estimator.relocations_per_update = value_of(mean_of(present(rates)));
  const auto mean_time = [&](double Percentiles::*which) {
    return value_of(mean_of(values([which](const EstimatorScore& score) {
      return score.update_us ? std::optional((*score.update_us).*which) : std::nullopt;
    })));
  };
  estimator.update_p50_us = mean_time(&Percentiles::p50);
  estimator.update_p99_us = mean_time(&Percentiles::p99);
}

}  // namespace

void compare_estimators(Comparison& comparison) {
  const std::span<const ComparedRun> runs = comparison.runs;
  for (const std::string& name : names_of(runs)) {
    EstimatorComparison estimator;
    estimator.name = name;
    for (const ComparedRun& run : runs) {
      if (!takes_part(run, name)) continue;
      ++(finished(run, name) == nullptr ? estimator.failed : estimator.runs);
    }
    compare_errors(runs, comparison.baseline, estimator);
    estimator.nees_pose = mean_of_positive(
        present(collect(runs, name, [](const EstimatorScore& score) { return score.nees_pose_final; })));
    estimator.nees_landmark = mean_of_positive(
        present(collect(runs, name, [](const EstimatorScore& score) { return score.nees_landmark_final; })));
    compare_details(runs, estimator);
    compare_losses(runs, estimator);
    compare_costs(runs, estimator);
    comparison.estimators.push_back(std::move(estimator));
  }
}

int exit_code(const Comparison& comparison) {
  if (comparison.interrupted) return 130;
  int code = 0;
  for (const ComparedRun& run : comparison.runs) code = std::max(code, exit_code(run.result));
  return code;
}

}  // namespace harness
