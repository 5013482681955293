#include "harness/stress/stress_report.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "harness/files/text_table.hpp"
#include "harness/stress/scaling.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json percentiles_json(const std::optional<Percentiles>& values) {
  if (!values) return nullptr;
  return {{"p50", values->p50}, {"p95", values->p95}, {"p99", values->p99}, {"max", values->max}};
}

double each(std::int64_t count, std::int64_t of) {
  return of > 0 ? static_cast<double>(count) / static_cast<double>(of) : 0.0;
}

Json estimator_json(const StressEstimator& estimator) {
  return {{"skipped", estimator.skipped.empty() ? Json(nullptr) : Json(estimator.skipped)},
          {"landmarks", estimator.landmarks},
          {"update_us", percentiles_json(estimator.update_us)},
          {"blocks_touched", percentiles_json(estimator.blocks)},
          {"memory_bytes", estimator.bytes},
          {"map_read_s", number(estimator.map_read_s)},
          {"landmark_rmse_aligned_m", number(estimator.map_rmse)},
          {"aligned_over_reference", number(estimator.over_reference)},
          {"nees_pose", number(estimator.nees_pose)},
          {"nees_landmark", number(estimator.nees_landmark)}};
}

Json row_json(const StressRow& row) {
  Json json = {
      {"landmarks", row.landmarks},
      {"load_s", row.load_s},
      {"build_s", row.build_s},
      {"warm_start", {{"s", row.warm_s}, {"updates", row.warm_updates}, {"seen", row.landmarks_seen}}},
      {"updates", row.updates},
      {"physics_step_us", percentiles_json(row.step_us)},
      {"scan_us", percentiles_json(row.scan_us)},
      {"rest_us", percentiles_json(row.rest_us)},
      {"simulated_second_us", percentiles_json(row.second_us)},
      {"realtime_factor", row.realtime_factor},
      {"objects_per_step", each(row.counts.objects_stepped, row.counts.steps)},
      {"rays_per_scan", each(row.counts.rays, row.updates)},
      {"candidates_per_scan", each(row.counts.candidates, row.updates)},
      {"process_bytes", row.process_bytes},
      {"bytes_by_landmark", row.bytes_by_landmark},
      {"growth_bytes_by_hour", row.growth_bytes_by_hour},
      {"estimators", Json::object()}};
  for (const StressEstimator& estimator : row.estimators)
    json["estimators"][estimator.name] = estimator_json(estimator);
  return json;
}

Json slope_json(const StageScaling& stage) {
  const bool is_bounded = stage.slope && stage.slope->interval;
  return {{"value", stage.slope ? Json(stage.slope->value) : Json(nullptr)},
          {"low", is_bounded ? Json(stage.slope->interval->low) : Json(nullptr)},
          {"high", is_bounded ? Json(stage.slope->interval->high) : Json(nullptr)}};
}

TextRow time_row(std::int64_t landmarks, const std::string& stage, const std::optional<Percentiles>& us) {
  if (!us) return {fmt::format("{}", landmarks), stage, "-", "-", "-", "-"};
  return {fmt::format("{}", landmarks), stage,
          number_cell(us->p50, 1),      number_cell(us->p95, 1),
          number_cell(us->p99, 1),      number_cell(us->max, 1)};
}

std::string time_table(const StressResult& result) {
  std::vector<TextRow> table = {{"landmarks", "time [us]", "p50", "p95", "p99", "max"}};
  for (const StressRow& row : result.rows) {
    table.push_back(time_row(row.landmarks, "physics step", row.step_us));
    table.push_back(time_row(row.landmarks, "scan", row.scan_us));
    for (const StressEstimator& estimator : row.estimators) {
      if (estimator.update_us)
        table.push_back(time_row(row.landmarks, estimator.name + " update", estimator.update_us));
    }
    table.push_back(time_row(row.landmarks, "rest of a cycle", row.rest_us));
    table.push_back(time_row(row.landmarks, "simulated second", row.second_us));
  }
  return text_table(table);
}

std::string whole_table(const StressResult& result) {
  std::vector<TextRow> table = {{"landmarks", "load [s]", "build [s]", "warm start [s]", "its updates",
                                 "seen", "measured", "x real time", "objects/step", "rays/scan",
                                 "process [MB]", "[B]/landmark", "growth [kB/h]"}};
  for (const StressRow& row : result.rows) {
    table.push_back({fmt::format("{}", row.landmarks), number_cell(row.load_s, 2),
                     number_cell(row.build_s, 2), number_cell(row.warm_s, 1),
                     fmt::format("{}", row.warm_updates), fmt::format("{}", row.landmarks_seen),
                     fmt::format("{}", row.updates), number_cell(row.realtime_factor, 1),
                     number_cell(each(row.counts.objects_stepped, row.counts.steps), 2),
                     number_cell(each(row.counts.rays, row.updates), 1),
                     number_cell(1e-6 * row.process_bytes, 0), number_cell(row.bytes_by_landmark, 0),
                     number_cell(1e-3 * row.growth_bytes_by_hour, 0)});
  }
  return text_table(table);
}

TextRow estimator_row(std::int64_t landmarks, const StressEstimator& estimator) {
  const auto part = [](const std::optional<Percentiles>& values, double Percentiles::*which) {
    return number_cell(values ? std::optional((*values).*which) : std::nullopt, 0);
  };
  const bool ran = estimator.skipped.empty();
  const double by_landmark =
      estimator.bytes / static_cast<double>(std::max<std::int64_t>(estimator.landmarks, 1));
  return {fmt::format("{}", landmarks),
          estimator.name,
          ran ? fmt::format("{}", estimator.landmarks) : "-",
          part(estimator.blocks, &Percentiles::p50),
          part(estimator.blocks, &Percentiles::p99),
          part(estimator.blocks, &Percentiles::max),
          ran ? number_cell(by_landmark, 0) : "-",
          number_cell(estimator.map_read_s ? std::optional(1e3 * *estimator.map_read_s) : std::nullopt, 1),
          number_cell(estimator.map_rmse, 4),
          number_cell(estimator.over_reference, 2),
          number_cell(estimator.nees_pose, 2),
          number_cell(estimator.nees_landmark, 2)};
}

std::string estimator_table(const StressResult& result) {
  std::vector<TextRow> table = {{"landmarks", "estimator", "in map", "blocks p50", "p99", "max",
                                 "[B]/landmark", "read map [ms]", "aligned [m]", "x reference", "NEES pose",
                                 "NEES map"}};
  std::string skipped;
  for (const StressRow& row : result.rows) {
    for (const StressEstimator& estimator : row.estimators) {
      table.push_back(estimator_row(row.landmarks, estimator));
      if (!estimator.skipped.empty())
        skipped += fmt::format("{} landmarks, {}: {}\n", row.landmarks, estimator.name, estimator.skipped);
    }
  }
  return text_table(table) + skipped;
}

std::string slope_table(const StressResult& result) {
  std::vector<TextRow> table = {{"log time against log landmarks", "slope", "95 % interval"}};
  for (const StageScaling& stage : scaling_of(result.rows)) {
    if (!stage.slope) continue;
    const std::optional<ConfidenceInterval>& interval = stage.slope->interval;
    table.push_back({stage.name, fmt::format("{:.3f}", stage.slope->value),
                     interval ? fmt::format("{:.3f} to {:.3f}", interval->low, interval->high) : "-"});
  }
  return text_table(table);
}

}  // namespace

std::string stress_tables(const StressPlan& plan, const StressResult& result) {
  return fmt::format(
      "{}, {} landmarks for each square metre, seed {}, {} updates measured after a warm start: each filter\n"
      "has first mapped the world with the engine without contacts, on the same sensors and rates; then the\n"
      "same filter goes on live in Bullet, and is recorded; places along a second round: {}.\n\n"
      "{}\n{}\n{}\n{}",
      stress_pattern_names.at(static_cast<std::size_t>(plan.world.pattern)), plan.world.density,
      plan.world.seed, plan.updates, plan.places, time_table(result), whole_table(result),
      estimator_table(result), slope_table(result));
}

std::string to_json(const StressPlan& plan, const StressResult& result) {
  Json json;
  json["pattern"] = stress_pattern_names.at(static_cast<std::size_t>(plan.world.pattern));
  json["density_per_m2"] = plan.world.density;
  json["seed"] = plan.world.seed;
  json["places"] = plan.places;
  json["reference"] = plan.reference.empty() ? Json(nullptr) : Json(plan.reference);
  json["version"] = program_version();
  json["interrupted"] = result.interrupted;
  json["rows"] = Json::array();
  for (const StressRow& row : result.rows) json["rows"].push_back(row_json(row));
  json["slopes"] = Json::object();
  for (const StageScaling& stage : scaling_of(result.rows)) json["slopes"][stage.name] = slope_json(stage);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace harness
