// The details of a run as JSON and as tables.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/files/text_table.hpp"
#include "harness/score/details.hpp"
#include "harness/statistics/chi_square.hpp"
#include "harness/statistics/degrees.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

void add_trajectory(const RunDetails& run, const EstimatorDetails& details, Json& json) {
  for (std::size_t i = 0; i < details.rpe.size(); ++i) {
    json["rpe_along_path"][fmt::format("{}", run.choices.distances[i])] = {
        {"trans_m", number_or_null(details.rpe[i].translation)},
        {"rot_rad", number_or_null(details.rpe[i].rotation)}};
  }
  for (std::size_t i = 0; i < response_updates.size(); ++i)
    json["loop_closure_error_m"][fmt::format("{}", response_updates[i])] =
        number_or_null(details.closure_error[i]);
}

void add_rebuilt(const RebuiltScore& rebuilt, Json& json) {
  json["nees_landmark_from_robot"] = number_or_null(rebuilt.nees_landmark_from_robot);
  json["nees_landmark_from_robot_final"] = number_or_null(rebuilt.nees_landmark_from_robot_final);
  json["nees_landmark_from_robot_inside"] = number_or_null(rebuilt.landmarks_from_robot_inside);
  json["nis"] = number_or_null(rebuilt.nis);
  json["nis_inside"] = number_or_null(rebuilt.nis_inside);
  json["nis_inside_of"] = rebuilt.observations;
  const ScanNisScore& scans = rebuilt.scans;
  json["nis_scan"] = number_or_null(scans.nis);
  json["nis_scan_band"] = {
      {"low", number_or_null(scans.band ? std::optional(scans.band->low) : std::nullopt)},
      {"high", number_or_null(scans.band ? std::optional(scans.band->high) : std::nullopt)}};
  json["nis_scan_inside"] = number_or_null(scans.inside);
  json["nis_scan_inside_of"] = scans.count;
}

void add_estimator(const RunDetails& run, const EstimatorDetails& details, Json& json) {
  const std::optional<MapCounts>& map = details.map;
  json["landmarks_missed"] = map && map->missed ? Json(*map->missed) : Json(nullptr);
  json["landmarks_duplicate"] = map ? Json(map->duplicate) : Json(nullptr);
  json["landmark_rmse_from_robot_m"] = number_or_null(details.landmark_rmse_from_robot);
  json["nees_pose_inside"] = number_or_null(details.pose_inside);
  json["nees_pose_inside_of"] = details.poses_scored;
  json["nees_landmark_inside"] = number_or_null(details.landmarks_inside);
  add_rebuilt(details.rebuilt, json);
  if (details.from_reference) {
    const DistanceFromReference& distance = *details.from_reference;
    json["from_reference"] = {{"landmark_rmse_m", number_or_null(distance.landmarks.rmse)},
                              {"landmark_rmse_aligned_m", number_or_null(distance.landmarks.rmse_aligned)},
                              {"ate_rmse_m", number_or_null(distance.trajectory.rmse)},
                              {"ate_rmse_aligned_m", number_or_null(distance.trajectory.rmse_aligned)}};
  }
  add_trajectory(run, details, json);
}

std::string count_cell(const std::optional<MapCounts>& map, int MapCounts::*which) {
  return map ? fmt::format("{}", (*map).*which) : "-";
}

std::string percent_cell(std::optional<double> share) {
  if (share) *share *= 100.0;
  return number_cell(share, 0);
}

std::string band_cell(const std::optional<ConfidenceInterval>& band) {
  return band ? fmt::format("{:.2f} to {:.2f}", band->low, band->high) : "-";
}

TextRow map_row(const EstimatorDetails& details) {
  return {details.name,
          details.map && details.map->missed ? fmt::format("{}", *details.map->missed) : "-",
          count_cell(details.map, &MapCounts::spurious),
          count_cell(details.map, &MapCounts::duplicate),
          number_cell(details.landmark_rmse_from_robot, 3),
          percent_cell(details.pose_inside),
          fmt::format("{}", details.poses_scored),
          percent_cell(details.landmarks_inside)};
}

TextRow rebuilt_row(const EstimatorDetails& details) {
  const RebuiltScore& rebuilt = details.rebuilt;
  return {details.name,
          number_cell(rebuilt.nees_landmark_from_robot, 2),
          number_cell(rebuilt.nees_landmark_from_robot_final, 2),
          percent_cell(rebuilt.landmarks_from_robot_inside),
          number_cell(rebuilt.nis, 2),
          percent_cell(rebuilt.nis_inside),
          fmt::format("{}", rebuilt.observations),
          number_cell(rebuilt.scans.nis, 2),
          band_cell(rebuilt.scans.band),
          percent_cell(rebuilt.scans.inside),
          fmt::format("{}", rebuilt.scans.count)};
}

/// Empty if no reference was asked for.
std::vector<TextRow> reference_table(const RunDetails& details) {
  if (details.reference.empty()) return {};
  std::vector<TextRow> table = {
      {"from " + details.reference, "map [m]", "aligned [m]", "positions [m]", "aligned [m]"}};
  for (const EstimatorDetails& estimator : details.estimators) {
    if (!estimator.from_reference) continue;
    const DistanceFromReference& distance = *estimator.from_reference;
    table.push_back({estimator.name, number_cell(distance.landmarks.rmse, 3),
                     number_cell(distance.landmarks.rmse_aligned, 3),
                     number_cell(distance.trajectory.rmse, 3),
                     number_cell(distance.trajectory.rmse_aligned, 3)});
  }
  return table;
}

TextRow path_row(const EstimatorDetails& details) {
  TextRow row = {details.name};
  for (const RelativePoseError& error : details.rpe) {
    row.push_back(number_cell(error.translation, 4));
    row.push_back(
        number_cell(error.rotation ? std::optional(*error.rotation * degrees_per_radian) : std::nullopt, 3));
  }
  return row;
}

TextRow closure_row(const EstimatorDetails& details) {
  TextRow row = {details.name};
  for (const std::optional<double>& error : details.closure_error) row.push_back(number_cell(error, 3));
  return row;
}

}  // namespace

std::string to_json(const Summary& summary, const RunDetails& details) {
  Json json = Json::parse(to_json(summary));
  const auto band = [](int dof) { return Json{chi_square_band(dof).low, chi_square_band(dof).high}; };
  json["nees_pose_band"] = band(3);
  json["nees_landmark_band"] = band(2);
  json["loop_closures"] = details.closures;
  json["loop_closure_away_s"] = details.choices.away;
  for (const auto& [name, why] : details.missing_references) json["missing_references"][name] = why;
  add_trajectory(details, details.odometry, json["odometry"]);
  for (const EstimatorDetails& estimator : details.estimators)
    add_estimator(details, estimator, json["estimators"][estimator.name]);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::vector<TextRow>> details_tables(const RunDetails& details) {
  std::vector<TextRow> map = {{"map", "missed", "spurious", "duplicate", "from robot [m]", "pose inside [%]",
                               "of", "map inside [%]"}};
  std::vector<TextRow> rebuilt = {{"from robot", "NEES map", "at the end", "inside [%]", "NIS", "inside [%]",
                                   "of", "NIS of scans", "95 % band", "inside [%]", "of"}};
  std::vector<TextRow> path = {{"RPE along path"}};
  for (const double distance : details.choices.distances) {
    path.front().push_back(fmt::format("{} m [m]", distance));
    path.front().emplace_back("[deg]");
  }
  std::vector<TextRow> closure = {{"updates since closure", "before"}};
  for (std::size_t i = 1; i < response_updates.size(); ++i)
    closure.front().push_back(fmt::format("{}", response_updates[i]));
  const auto add_moving = [&](const EstimatorDetails& estimator) {
    path.push_back(path_row(estimator));
    closure.push_back(closure_row(estimator));
  };
  for (const EstimatorDetails& estimator : details.estimators) {
    map.push_back(map_row(estimator));
    rebuilt.push_back(rebuilt_row(estimator));
    add_moving(estimator);
  }
  add_moving(details.odometry);
  std::vector<std::vector<TextRow>> tables = {map, rebuilt, path};
  if (details.closures > 0) tables.push_back(closure);
  if (!details.reference.empty()) tables.push_back(reference_table(details));
  return tables;
}

std::string details_board(const RunDetails& details) {
  const std::vector<std::vector<TextRow>> tables = details_tables(details);
  std::string text = text_table(tables[0]) + '\n' + text_table(tables[1]) + '\n' + text_table(tables[2]);
  if (!details.reference.empty()) text += '\n' + text_table(tables.back());
  for (const auto& [name, why] : details.missing_references)
    text += fmt::format("\nThe reference {} is missing: {}\n", name, why);
  if (details.closures == 0) return text + "\nNo loop closes.\n";
  return text +
         fmt::format("\nError of the position [m], {} closures\n{}", details.closures, text_table(tables[3]));
}

}  // namespace harness
