#include "harness/comparison/comparison_keys.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <variant>

namespace harness {

namespace {

using Json = nlohmann::ordered_json;
using Member = std::variant<int EstimatorComparison::*, std::optional<double> EstimatorComparison::*,
                            std::optional<Estimate> EstimatorComparison::*>;

struct Key {
  const char* name;
  Member member;
};

const Key keys[] = {
    {"runs", &EstimatorComparison::runs},
    {"failed", &EstimatorComparison::failed},
    {"landmark_mse_m2", &EstimatorComparison::landmark_mse},
    {"landmark_mse_median_m2", &EstimatorComparison::landmark_mse_median},
    {"landmark_mse_ratio", &EstimatorComparison::landmark_mse_ratio},
    {"landmark_mse_ratio_of_means", &EstimatorComparison::landmark_mse_ratio_of_means},
    {"landmark_rmse_aligned_m", &EstimatorComparison::landmark_aligned},
    {"landmark_rmse_aligned_ratio", &EstimatorComparison::aligned_ratio},
    {"landmark_rmse_aligned_ratio_median", &EstimatorComparison::aligned_ratio_median},
    {"nees_pose_final", &EstimatorComparison::nees_pose},
    {"nees_landmark_final", &EstimatorComparison::nees_landmark},
    {"nees_landmark_from_robot_final", &EstimatorComparison::nees_from_robot},
    {"nis_scan", &EstimatorComparison::nis_scan},
    {"nis_scan_inside", &EstimatorComparison::nis_scan_inside},
    {"landmarks_missed", &EstimatorComparison::landmarks_missed},
    {"landmarks_spurious", &EstimatorComparison::landmarks_spurious},
    {"landmarks_duplicate", &EstimatorComparison::landmarks_duplicate},
    {"links", &EstimatorComparison::links},
    {"links_max", &EstimatorComparison::links_max},
    {"relocations_per_update", &EstimatorComparison::relocations_per_update},
    {"losses", &EstimatorComparison::losses},
    {"relocalised", &EstimatorComparison::relocalised},
    {"relocalised_wrongly", &EstimatorComparison::relocalised_wrongly},
    {"lost_s", &EstimatorComparison::lost_s},
    {"update_p50_us", &EstimatorComparison::update_p50_us},
    {"update_p99_us", &EstimatorComparison::update_p99_us},
};

Json json_of_value(int value) { return value; }

Json json_of_value(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of_value(const std::optional<Estimate>& value) {
  const bool is_bounded = value && value->interval;
  return {{"value", value ? Json(value->value) : Json(nullptr)},
          {"low", is_bounded ? Json(value->interval->low) : Json(nullptr)},
          {"high", is_bounded ? Json(value->interval->high) : Json(nullptr)}};
}

void read_value(const Json& json, int& value) { value = json.get<int>(); }

void read_value(const Json& json, std::optional<double>& value) {
  if (!json.is_null()) value = json.get<double>();
}

void read_value(const Json& json, std::optional<Estimate>& value) {
  if (json.at("value").is_null()) return;
  value = Estimate{json.at("value").get<double>(), {}};
  if (!json.at("low").is_null())
    value->interval = ConfidenceInterval{json.at("low").get<double>(), json.at("high").get<double>()};
}

ComparedRun parse_run(const Json& json) {
  ComparedRun run;
  run.name = json.at("name");
  if (!json.at("error").is_null()) run.result.error = json.at("error");
  std::istringstream summary(json.at("summary").dump());
  run.result.summary = parse_summary(summary);
  return run;
}

}  // namespace

std::string comparison_keys_json(const EstimatorComparison& estimator) {
  Json json;
  for (const Key& key : keys)
    json[key.name] = std::visit([&](auto member) { return json_of_value(estimator.*member); }, key.member);
  return json.dump();
}

void read_comparison_keys(const std::string& text, EstimatorComparison& estimator) {
  const Json json = Json::parse(text);
  for (const Key& key : keys) {
    if (!json.contains(key.name)) continue;
    std::visit([&](auto member) { read_value(json.at(key.name), estimator.*member); }, key.member);
  }
}

Comparison parse_comparison(const std::string& text) {
  const Json json = Json::parse(text);
  Comparison comparison;
  comparison.name = json.at("name");
  comparison.baseline = json.at("baseline");
  comparison.interrupted = json.at("interrupted");
  for (const auto& [name, values] : json.at("estimators").items()) {
    comparison.estimators.emplace_back().name = name;
    read_comparison_keys(values.dump(), comparison.estimators.back());
  }
  if (!json.at("runs").is_array()) return comparison;
  for (const Json& run : json.at("runs")) comparison.runs.push_back(parse_run(run));
  return comparison;
}

}  // namespace harness
