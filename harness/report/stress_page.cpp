#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/report/pages.hpp"
#include "harness/stress/scaling.hpp"
#include "harness/stress/stress_plot.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

std::optional<Percentiles> percentiles_of(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return Percentiles{json.at("p50"), json.at("p95"), json.at("p99"), json.at("max")};
}

/// The part of stress.json that the plot needs.
std::vector<StressRow> rows_of(const Json& json) {
  std::vector<StressRow> rows;
  for (const Json& from : json.at("rows")) {
    StressRow& row = rows.emplace_back();
    row.landmarks = from.at("landmarks");
    row.step_us = percentiles_of(from.at("physics_step_us"));
    row.scan_us = percentiles_of(from.at("scan_us"));
    row.rest_us = percentiles_of(from.at("rest_us"));
    row.second_us = percentiles_of(from.at("simulated_second_us"));
    for (const auto& [name, estimator] : from.at("estimators").items()) {
      row.estimators.emplace_back().name = name;
      row.estimators.back().update_us = percentiles_of(estimator.at("update_us"));
    }
  }
  return rows;
}

std::string cell(const Json& json, int decimals, double scale = 1.0) {
  return number_cell(json.is_number() ? std::optional(scale * json.get<double>()) : std::nullopt, decimals);
}

TextRow time_row(const Json& row, const std::string& stage, const Json& us) {
  TextRow cells = {fmt::format("{}, {}", row.at("landmarks").get<std::int64_t>(), stage)};
  for (const char* part : {"p50", "p95", "p99", "max"})
    cells.push_back(us.is_null() ? "-" : cell(us.at(part), 1));
  return cells;
}

Table times_of(const Json& json) {
  Table table{"Times", {{"landmarks, stage", "p50 [us]", "p95 [us]", "p99 [us]", "max [us]"}}, {}};
  for (const Json& row : json.at("rows")) {
    table.rows.push_back(time_row(row, "physics step", row.at("physics_step_us")));
    table.rows.push_back(time_row(row, "scan", row.at("scan_us")));
    for (const auto& [name, estimator] : row.at("estimators").items()) {
      if (name != json.value("reference", Json()))
        table.rows.push_back(time_row(row, name + " update", estimator.at("update_us")));
    }
    table.rows.push_back(time_row(row, "rest of a cycle", row.at("rest_us")));
    table.rows.push_back(time_row(row, "simulated second", row.at("simulated_second_us")));
  }
  return table;
}

Table whole_of(const Json& json) {
  Table table{"The whole",
              {{"landmarks", "load [s]", "build [s]", "warm start [s]", "its updates", "seen", "measured",
                "x real time", "objects/step", "rays/scan", "process [MB]", "[B]/landmark", "growth [kB/h]"}},
              "Its updates: those of the warm start, in which the filters map the world; seen: landmarks "
              "seen in it; measured: the updates after it, to which all other numbers belong."};
  for (const Json& row : json.at("rows")) {
    const Json& warm = row.at("warm_start");
    table.rows.push_back({cell(row.at("landmarks"), 0), cell(row.at("load_s"), 2), cell(row.at("build_s"), 2),
                          cell(warm.at("s"), 1), cell(warm.at("updates"), 0), cell(warm.at("seen"), 0),
                          cell(row.at("updates"), 0), cell(row.at("realtime_factor"), 1),
                          cell(row.at("objects_per_step"), 2), cell(row.at("rays_per_scan"), 1),
                          cell(row.at("process_bytes"), 0, 1e-6), cell(row.at("bytes_by_landmark"), 0),
                          cell(row.at("growth_bytes_by_hour"), 0, 1e-3)});
  }
  return table;
}

Table estimators_of(const Json& json) {
  Table table{"The estimators",
              {{"landmarks, estimator", "in map", "state [KiB]", "read map [ms]", "aligned [m]",
                "x reference", "NEES pose", "NEES map"}},
              {}};
  for (const Json& row : json.at("rows")) {
    for (const auto& [name, estimator] : row.at("estimators").items()) {
      const std::string first = fmt::format("{}, {}", row.at("landmarks").get<std::int64_t>(), name);
      if (!estimator.at("skipped").is_null()) {
        table.note += fmt::format("{}: {} ", first, estimator.at("skipped").get<std::string>());
        continue;
      }
      table.rows.push_back({first, cell(estimator.at("landmarks"), 0),
                            cell(estimator.at("memory_bytes"), 1, 1.0 / 1024),
                            cell(estimator.value("map_read_s", Json()), 1, 1e3),
                            cell(estimator.at("landmark_rmse_aligned_m"), 4),
                            cell(estimator.value("aligned_over_reference", Json()), 2),
                            cell(estimator.at("nees_pose"), 2), cell(estimator.at("nees_landmark"), 2)});
    }
  }
  return table;
}

Table slopes_of(const Json& json) {
  Table table{"Growth",
              {{"log time against log landmarks", "slope", "low", "high"}},
              "0 is constant time, 2 a dense filter's. With the 95 % interval, which takes three sizes."};
  for (const auto& [stage, slope] : json.at("slopes").items())
    table.rows.push_back(
        {stage, cell(slope.at("value"), 3), cell(slope.at("low"), 3), cell(slope.at("high"), 3)});
  return table;
}

Page page_of_json(const Json& json) {
  Page page;
  const std::string pattern = json.at("pattern");
  page.title = "Stress test, " + pattern;
  page.facts = {
      {"Pattern", pattern},
      {"Seed", fmt::format("{}", json.at("seed").get<std::uint64_t>())},
      {"Landmarks for each square metre", fmt::format("{}", json.at("density_per_m2").get<double>())},
      {"Made by version", json.at("version").get<std::string>()}};
  if (json.at("interrupted").get<bool>()) page.facts.push_back({"Interrupted", "before its end"});
  page.details = {times_of(json), whole_of(json), estimators_of(json), slopes_of(json)};
  const std::vector<StressRow> rows = rows_of(json);
  if (!rows.empty()) page.figures = {scaling_figure(scaling_of(rows))};
  return page;
}

}  // namespace

Page stress_page(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "stress.json";
  const std::string text = read_whole_file(file);
  try {
    return page_of_json(Json::parse(text));
  } catch (const Json::exception& error) {
    throw BadInput(fmt::format("{}: is no result of a stress test: {}", file.string(), error.what()));
  }
}

}  // namespace harness
