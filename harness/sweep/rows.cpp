#include "harness/sweep/rows.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

bool is_time(std::string_view key) {
  return key == "update_us" || key == "stage_us" || key == "realtime_factor";
}

void add_value(const std::string& name, const Json& value, std::vector<NamedValue>& values) {
  if (value.is_object()) {
    for (const auto& [key, part] : value.items()) add_value(fmt::format("{}_{}", name, key), part, values);
  } else if (value.is_number()) {
    values.push_back({name, value.dump(), value.get<double>()});
  } else {
    values.push_back({name, value.is_string() ? value.get<std::string>() : "", std::nullopt});
  }
}

EstimatorRow row_of(const std::string& name, const Json& run, const Json& scores) {
  EstimatorRow row;
  row.estimator = name;
  for (const char* key : {"updates", "duration_s", "trajectory_hash"})
    add_value(key, run.at(key), row.scores);
  if (run.contains("loop_closures")) add_value("loop_closures", run["loop_closures"], row.scores);
  add_value("realtime_factor", run.at("realtime_factor"), row.times);
  for (const auto& [key, value] : scores.items()) {
    if (key == "failure") {
      if (value.is_string()) row.failure = value;
    } else {
      add_value(key, value, is_time(key) ? row.times : row.scores);
    }
  }
  return row;
}

}  // namespace

std::vector<EstimatorRow> rows_of(const std::string& summary, const std::string& file) {
  try {
    const Json run = Json::parse(summary);
    std::vector<EstimatorRow> rows;
    for (const auto& [name, scores] : run.at("estimators").items()) rows.push_back(row_of(name, run, scores));
    rows.push_back(row_of("odometry", run, run.at("odometry")));
    return rows;
  } catch (const Json::exception& error) {
    throw BadInput(fmt::format("{}: is no summary of a run: {}", file, error.what()));
  }
}

}  // namespace harness
