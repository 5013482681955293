// A comparison as JSON and as tables.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/comparison/comparison.hpp"
#include "harness/comparison/comparison_keys.hpp"
#include "harness/files/text_table.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

Json run_json(const ComparedRun& run) {
  const std::string& error = run.result.error;
  return {{"name", run.name},
          {"error", error.empty() ? Json(nullptr) : Json(error)},
          {"summary", Json::parse(to_json(DetailedRun{run.result, run.details}))}};
}

std::string value_cell(const std::optional<Estimate>& value, int decimals) {
  return number_cell(value ? std::optional(value->value) : std::nullopt, decimals);
}

std::string interval_cell(const std::optional<Estimate>& value, int decimals) {
  if (!value || !value->interval) return "-";
  return fmt::format("{} to {}", number_cell(value->interval->low, decimals),
                     number_cell(value->interval->high, decimals));
}

TextRow accuracy_row(const EstimatorComparison& estimator) {
  return {estimator.name,
          fmt::format("{}", estimator.runs),
          fmt::format("{}", estimator.failed),
          value_cell(estimator.landmark_mse, 4),
          interval_cell(estimator.landmark_mse, 4),
          value_cell(estimator.landmark_mse_ratio, 3),
          interval_cell(estimator.landmark_mse_ratio, 3),
          value_cell(estimator.landmark_aligned, 4),
          value_cell(estimator.aligned_ratio, 3),
          number_cell(estimator.aligned_ratio_median, 3)};
}

TextRow consistency_row(const EstimatorComparison& estimator) {
  std::optional<double> inside = estimator.nis_scan_inside;
  if (inside) *inside *= 100.0;
  return {estimator.name,
          value_cell(estimator.nees_pose, 2),
          interval_cell(estimator.nees_pose, 2),
          value_cell(estimator.nees_landmark, 2),
          interval_cell(estimator.nees_landmark, 2),
          value_cell(estimator.nees_from_robot, 2),
          interval_cell(estimator.nees_from_robot, 2),
          value_cell(estimator.nis_scan, 2),
          interval_cell(estimator.nis_scan, 2),
          number_cell(inside, 0)};
}

TextRow cost_row(const EstimatorComparison& estimator) {
  return {estimator.name,
          number_cell(estimator.landmarks_missed, 1),
          number_cell(estimator.landmarks_spurious, 1),
          number_cell(estimator.landmarks_duplicate, 1),
          value_cell(estimator.links, 0),
          number_cell(estimator.links_max, 0),
          number_cell(estimator.relocations_per_update, 3),
          number_cell(estimator.update_p50_us, 1),
          number_cell(estimator.update_p99_us, 1)};
}

/// Of those that were lost; empty if none was.
std::vector<TextRow> loss_table(const Comparison& comparison) {
  std::vector<TextRow> table = {{"lost and found", "lost", "found", "wrongly", "lost for [s]"}};
  for (const EstimatorComparison& estimator : comparison.estimators) {
    if (estimator.losses == 0) continue;
    table.push_back({estimator.name, fmt::format("{}", estimator.losses),
                     fmt::format("{}", estimator.relocalised),
                     fmt::format("{}", estimator.relocalised_wrongly), number_cell(estimator.lost_s, 1)});
  }
  return table.size() > 1 ? table : std::vector<TextRow>{};
}

std::string footnote(const std::string& baseline) {
  return fmt::format(
      "over {}: geometric mean over the runs of the ratio in the same run\n"
      "95 %: BCa bootstrap of the mean (below 8 runs Student's t of its logarithm); of a ratio Student's t "
      "of "
      "the mean logarithm\n",
      baseline);
}

/// One line for a failed run, or for each estimator that failed in it.
std::string failures(const ComparedRun& run) {
  if (!run.result.error.empty()) return fmt::format("{} failed: {}\n", run.name, run.result.error);
  const Summary& summary = run.result.summary;
  std::string text;
  for (std::size_t i = 0; i < summary.failures.size(); ++i) {
    if (summary.failures[i].empty()) continue;
    text +=
        fmt::format("{}: {} failed {}\n", run.name, summary.score.estimators[i].name, summary.failures[i]);
  }
  return text;
}

/// The notes of all runs, each once.
std::vector<std::string> notes_of(const Comparison& comparison) {
  std::vector<std::string> notes;
  for (const ComparedRun& run : comparison.runs) {
    for (const std::string& note : run.result.summary.notes) {
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
    }
  }
  return notes;
}

}  // namespace

std::string failures_of(const Comparison& comparison) {
  std::string text;
  for (const ComparedRun& run : comparison.runs) text += failures(run);
  return text;
}

std::string to_json(const Comparison& comparison) {
  Json json;
  json["name"] = comparison.name;
  json["version"] = program_version();
  json["baseline"] = comparison.baseline;
  json["interrupted"] = comparison.interrupted;
  json["seeds"] = Json::array();  // in the order of the runs
  for (const ComparedRun& run : comparison.runs) json["seeds"].push_back(run.result.summary.seed);
  json["estimators"] = Json::object();
  for (const EstimatorComparison& estimator : comparison.estimators)
    json["estimators"][estimator.name] = Json::parse(comparison_keys_json(estimator));
  json["runs"] = Json::array();
  for (const ComparedRun& run : comparison.runs) json["runs"].push_back(run_json(run));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::vector<TextRow>> comparison_tables(const Comparison& comparison) {
  const std::string over = "over " + comparison.baseline;
  std::vector<TextRow> accuracy = {
      {"map error", "runs", "failed", "MSE [m^2]", "95 %", over, "95 %", "aligned [m]", over, "median"}};
  std::vector<TextRow> consistency = {{"at the end", "NEES pose", "95 %", "NEES map", "95 %", "from robot",
                                       "95 %", "NIS of scans", "95 %", "inside [%]"}};
  std::vector<TextRow> cost = {{"map and cost", "missed", "spurious", "duplicate", "links", "most",
                                "relocations", "p50 [us]", "p99 [us]"}};
  for (const EstimatorComparison& estimator : comparison.estimators) {
    accuracy.push_back(accuracy_row(estimator));
    consistency.push_back(consistency_row(estimator));
    cost.push_back(cost_row(estimator));
  }
  std::vector<std::vector<TextRow>> tables = {accuracy, consistency, cost};
  if (std::vector<TextRow> losses = loss_table(comparison); !losses.empty())
    tables.push_back(std::move(losses));
  return tables;
}

std::string comparison_board(const Comparison& comparison) {
  std::string text = fmt::format("{}, {} runs{}\n\n", comparison.name, comparison.runs.size(),
                                 comparison.interrupted ? " (interrupted)" : "");
  for (const std::vector<TextRow>& table : comparison_tables(comparison)) text += text_table(table) + '\n';
  text += footnote(comparison.baseline);
  for (const std::string& note : notes_of(comparison)) text += note + '\n';
  const std::string failed = failures_of(comparison);
  return failed.empty() ? text : text + '\n' + failed;
}

}  // namespace harness
