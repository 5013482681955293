// An aggregate as JSON, as CSV and as a table.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/comparison/seeds.hpp"
#include "harness/files/csv_writer.hpp"
#include "harness/files/text_table.hpp"
#include "harness/sweep/aggregate.hpp"
#include "harness/sweep/status.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

Json estimate(const std::optional<Estimate>& value) {
  if (!value) return nullptr;
  const bool is_bounded = value->interval.has_value();
  return {{"value", value->value},
          {"low", is_bounded ? Json(value->interval->low) : Json(nullptr)},
          {"high", is_bounded ? Json(value->interval->high) : Json(nullptr)}};
}

Json estimator_json(const EstimatorStatistics& estimator) {
  Json json = {{"runs", estimator.runs}, {"failed", estimator.failed}, {"scores", Json::object()}};
  for (const ScoreStatistics& score : estimator.scores) {
    json["scores"][score.name] = {{"runs", score.runs},
                                  {"mean", estimate(score.mean)},
                                  {"median", score.median},
                                  {"pairs", score.pairs},
                                  {"difference", estimate(score.difference)}};
  }
  return json;
}

Json setting_json(const SweepPlan& plan, const SettingStatistics& setting) {
  Json json = {{"values", Json::object()}, {"estimators", Json::object()}};
  for (std::size_t i = 0; i < plan.axes.size(); ++i) json["values"][plan.axes[i].path] = setting.values[i];
  for (const EstimatorStatistics& estimator : setting.estimators)
    json["estimators"][estimator.name] = estimator_json(estimator);
  return json;
}

/// The value and the bounds of its interval as three cells of a row, with a comma before each.
std::string cells_of(const std::optional<Estimate>& value) {
  if (!value) return ",,,";
  if (!value->interval) return fmt::format(",{},,", value->value);
  return fmt::format(",{},{},{}", value->value, value->interval->low, value->interval->high);
}

std::string mean_cell(const EstimatorStatistics& estimator, const char* score, int decimals) {
  const ScoreStatistics* found = estimator.find(score);
  return number_cell(found == nullptr ? std::nullopt : std::optional(found->mean.value), decimals);
}

std::string difference_cell(const EstimatorStatistics& estimator, const char* score, int decimals) {
  const ScoreStatistics* found = estimator.find(score);
  if (found == nullptr || !found->difference) return "-";
  const Estimate& difference = *found->difference;
  if (!difference.interval) return number_cell(difference.value, decimals);
  return fmt::format("{} to {}", number_cell(difference.interval->low, decimals),
                     number_cell(difference.interval->high, decimals));
}

constexpr const char* interval_methods =
    "95 % confidence: of a mean BCa bootstrap, below 8 runs Student's t of its logarithm (Student's t of the "
    "mean where a value is negative); of a difference Student's t";

TextRow board_row(const SettingStatistics& setting, const EstimatorStatistics& estimator) {
  TextRow row = setting.values;
  row.push_back(estimator.name);
  for (const std::size_t count : {estimator.runs, estimator.failed}) row.push_back(fmt::format("{}", count));
  row.push_back(mean_cell(estimator, "landmark_rmse_aligned_m", 4));
  row.push_back(difference_cell(estimator, "landmark_rmse_aligned_m", 4));
  row.push_back(mean_cell(estimator, "ate_rmse_m", 3));
  row.push_back(mean_cell(estimator, "nees_pose_final", 2));
  row.push_back(mean_cell(estimator, "nees_landmark_final", 2));
  row.push_back(mean_cell(estimator, "nees_landmark_from_robot_final", 2));
  row.push_back(mean_cell(estimator, "nis_scan", 2));
  row.push_back(mean_cell(estimator, "links", 0));
  return row;
}

}  // namespace

std::string to_json(const Aggregate& aggregate) {
  const SweepPlan& plan = aggregate.plan;
  Json json;
  json["name"] = plan.name;
  json["version"] = plan.version;
  json["baseline"] = plan.baseline;
  json["seeds"] = seeds_text(plan.seeds);
  json["interval"] = interval_methods;
  json["cells"] = cell_count(plan);
  json["failed"] = Json::array();
  for (const FailedCell& cell : aggregate.failed)
    json["failed"].push_back(
        {{"cell", cell.index}, {"of", describe_cell(plan, cell.index)}, {"reason", cell.reason}});
  json["settings"] = Json::array();
  for (const SettingStatistics& setting : aggregate.settings)
    json["settings"].push_back(setting_json(plan, setting));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_csv(const Aggregate& aggregate) {
  std::string text;
  for (const SweepAxis& axis : aggregate.plan.axes) text += csv_cell(axis.path) + ',';
  text +=
      "estimator,estimator_runs,estimator_failed,score,runs,mean,mean_low,mean_high,median,pairs,"
      "difference,difference_low,difference_high\n";
  for (const SettingStatistics& setting : aggregate.settings) {
    std::string values;
    for (const std::string& value : setting.values) values += csv_cell(value) + ',';
    for (const EstimatorStatistics& estimator : setting.estimators) {
      for (const ScoreStatistics& score : estimator.scores) {
        text += fmt::format("{}{},{},{},{},{}{},{},{}{}\n", values, estimator.name, estimator.runs,
                            estimator.failed, score.name, score.runs, cells_of(score.mean), score.median,
                            score.pairs, cells_of(score.difference));
      }
    }
  }
  return text;
}

std::vector<TextRow> aggregate_table(const Aggregate& aggregate) {
  const SweepPlan& plan = aggregate.plan;
  TextRow header = short_paths(plan);
  for (const char* column : {"estimator", "runs", "failed", "aligned [m]"}) header.emplace_back(column);
  header.push_back(fmt::format("less {}'s, 95 %", plan.baseline));
  for (const char* column : {"ATE [m]", "NEES pose", "NEES map", "from robot", "NIS", "links"})
    header.emplace_back(column);
  std::vector<TextRow> rows = {header};
  for (const SettingStatistics& setting : aggregate.settings) {
    for (const EstimatorStatistics& estimator : setting.estimators)
      rows.push_back(board_row(setting, estimator));
  }
  return rows;
}

std::string aggregate_board(const Aggregate& aggregate) {
  const SweepPlan& plan = aggregate.plan;
  std::string text = fmt::format("{}, seeds {}, {} settings, {} runs, {} of them failed\n\n{}", plan.name,
                                 seeds_text(plan.seeds), setting_count(plan), cell_count(plan),
                                 aggregate.failed.size(), text_table(aggregate_table(aggregate)));
  text += fmt::format(
      "\nless {}'s: 95 % interval of the mean difference in the same run (Student's t). Intervals of means "
      "are "
      "in aggregate.csv.\n",
      plan.baseline);
  return aggregate.failed.empty() ? text : text + '\n' + failed_lines(plan, aggregate.failed);
}

}  // namespace harness
