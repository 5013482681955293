#include "harness/score/summary.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <istream>
#include <nlohmann/json.hpp>
#include <optional>

#include "harness/files/bad_input.hpp"
#include "harness/files/input_file.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/recording/unfinished.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, stage_count> stage_names = {"motion", "measurement", "sparsification",
                                                              "mean_recovery"};

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

template <class Integer>
Json count(const std::optional<Integer>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json percentiles(const std::optional<Percentiles>& values) {
  if (!values) return {{"p50", nullptr}, {"p95", nullptr}, {"p99", nullptr}, {"max", nullptr}};
  return {{"p50", number(values->p50)},
          {"p95", number(values->p95)},
          {"p99", number(values->p99)},
          {"max", number(values->max)}};
}

void add_trajectory(Json& json, const EstimatorScore& score) {
  json["ate_rmse_m"] = number(score.trajectory.rmse);
  json["ate_rmse_aligned_m"] = number(score.trajectory.rmse_aligned);
  json["rpe_trans_m"] = number(score.rpe.translation);
  json["rpe_rot_rad"] = number(score.rpe.rotation);
}

Json matched_by(MatchedBy how) {
  switch (how) {
    case MatchedBy::id:
      return "id";
    case MatchedBy::vote:
      return "vote";
    case MatchedBy::place:
      return "place";
    case MatchedBy::nothing:
      break;
  }
  return nullptr;
}

Json estimator(const EstimatorScore& score, const std::string& failure) {
  Json json;
  json["landmarks_mapped"] = count(score.landmarks_mapped);
  json["landmarks_spurious"] = count(score.landmarks_spurious);
  json["landmarks_matched_by"] = score.landmarks_mapped ? matched_by(score.matched_by) : Json(nullptr);
  if (score.by_place) {
    json["landmarks_missed"] = count(score.by_place->missed);
    json["landmarks_duplicate"] = score.by_place->duplicate;
  }
  json["landmark_rmse_m"] = number(score.landmarks.rmse);
  json["landmark_rmse_aligned_m"] = number(score.landmarks.rmse_aligned);
  add_trajectory(json, score);
  json["nees_pose"] = number(score.nees_pose);
  json["nees_pose_final"] = number(score.nees_pose_final);
  json["nees_landmark"] = number(score.nees_landmark);
  json["nees_landmark_final"] = number(score.nees_landmark_final);
  json["improper_beliefs"] = score.improper_beliefs;
  json["improper_since_s"] = number(score.improper_t);
  json["diverged_s"] = number(score.diverged_t);
  json["nis_worst"] = number(score.worst_nis);
  json["diverged_nees_s"] = number(score.diverged_nees_t);
  json["update_us"] = percentiles(score.update_us);
  for (std::size_t stage = 0; stage < stage_count; ++stage) {
    if (score.stage_us[stage]) json["stage_us"][stage_names[stage]] = percentiles(score.stage_us[stage]);
  }
  json["blocks_touched"] = percentiles(score.blocks_touched);
  json["links"] = count(score.links);
  json["links_max"] = count(score.links_max);
  json["relocations"] = count(score.relocations);
  json["losses"] = score.losses.count();
  json["lost_s"] = score.losses.lost_s();
  json["relocalised"] = score.losses.found();
  json["relocalised_wrongly"] = score.losses.found_wrongly();
  json["relocalised_s"] = number(score.losses.first_found_t());
  json["gated"] = count(score.gated);
  json["weakened"] = count(score.weakened);
  if (score.associations_left_out) {
    json["associations_right"] = number(score.associations_right);
    json["associations_left_out"] = number(score.associations_left_out);
  }
  json["mean_residual"] = percentiles(score.mean_residual);
  json["anchoring_nat"] = number(score.anchoring);
  json["active_max"] = count(score.active_max);
  json["memory_bytes"] = count(score.memory_bytes);
  json["failure"] = failure.empty() ? Json(nullptr) : Json(failure);
  return json;
}

void read_left_out(const Json& left_out, Summary& summary) {
  for (const auto& [name, value] : left_out.items()) {
    if (name == "first_s") {
      if (!value.is_null()) summary.left_out_t = value.get<double>();
    } else {
      summary.left_out.emplace_back(name, value.get<std::int64_t>());
    }
  }
}

}  // namespace

Summary parse_summary(std::istream& text) {
  const Json json = Json::parse(text);
  Summary summary;
  summary.world = json.at("world");
  summary.seed = json.at("seed");
  summary.version = json.at("version");
  summary.duration = json.at("duration_s");
  summary.updates = json.at("updates");
  summary.interrupted = json.at("interrupted");
  const Json error = json.value("error", Json(nullptr));
  if (error.is_string()) summary.error = error.get<std::string>();
  summary.trajectory_hash = json.at("trajectory_hash");
  summary.realtime_factor = json.at("realtime_factor");
  summary.rpe_interval = json.at("rpe_interval_s");
  const Json log = json.value("log", Json::object());
  for (const auto& [name, count] : log.items())
    summary.log_counts.emplace_back(name, count.get<std::int64_t>());
  for (const Json& note : json.value("notes", Json::array())) summary.notes.push_back(note);
  read_left_out(json.value("left_out", Json::object()), summary);
  for (const auto& [name, score] : json.at("estimators").items()) {
    if (file_name_of(name) != name) throw BadInput(fmt::format("'{}' is no name of an estimator", name));
    summary.score.estimators.emplace_back().name = name;
    const Json& failure = score.at("failure");
    summary.failures.push_back(failure.is_null() ? "" : failure.get<std::string>());
  }
  return summary;
}

Summary read_summary(const std::filesystem::path& file) {
  refuse_team_folder(file.parent_path());
  const bool is_there = std::filesystem::exists(file);
  if (!is_there && is_going_on(file.parent_path()))
    throw BadInput(fmt::format(
        "{0}: is still going on; it has a summary when it ends. seifbed score {0}, and seifbed film "
        "{0}, take what there is of it so far",
        file.parent_path().string()));
  if (!is_there && is_unfinished(file.parent_path()))
    throw BadInput(
        fmt::format("{0}: was cut off before its end; seifbed run --resume {0} completes it, and "
                    "seifbed replay {0} makes a run of what there is",
                    file.parent_path().string()));
  if (!is_there)
    throw BadInput(fmt::format("{}: cannot be read; a run writes it when it ends, and so does a replay of it",
                               file.string()));
  std::ifstream text = open_input(file);
  try {
    return parse_summary(text);
  } catch (const Json::exception& error) {
    throw BadInput(fmt::format("{}: is no summary of a run: {}", file.string(), error.what()));
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}: is no summary of a run: {}", file.string(), error.what()));
  }
}

std::string to_json(const Summary& summary) {
  Json json;
  json["world"] = summary.world;
  json["seed"] = summary.seed;
  json["version"] = summary.version;
  json["duration_s"] = number(summary.duration);
  json["updates"] = summary.updates;
  json["interrupted"] = summary.interrupted;
  if (!summary.error.empty()) json["error"] = summary.error;
  json["trajectory_hash"] = summary.trajectory_hash;
  json["realtime_factor"] = number(summary.realtime_factor);
  json["rpe_interval_s"] = number(summary.rpe_interval);
  if (!summary.log_counts.empty()) {
    for (const auto& [name, count] : summary.log_counts) json["log"][name] = count;
  }
  if (!summary.left_out.empty()) {
    for (const auto& [name, count] : summary.left_out) json["left_out"][name] = count;
    json["left_out"]["first_s"] = number(summary.left_out_t);
  }
  json["true_frame_known"] = summary.score.frame_is_known;
  json["scoring_times_without_truth"] = summary.score.times_without_truth;
  if (!summary.notes.empty()) json["notes"] = summary.notes;
  json["odometry"] = Json::object();
  add_trajectory(json["odometry"], summary.score.odometry);
  json["estimators"] = Json::object();
  for (std::size_t i = 0; i < summary.score.estimators.size(); ++i) {
    const EstimatorScore& score = summary.score.estimators[i];
    json["estimators"][score.name] = estimator(score, summary.failures.at(i));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace harness
