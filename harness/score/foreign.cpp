#include "harness/score/foreign.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/csv_reader.hpp"
#include "harness/files/text_table.hpp"
#include "harness/statistics/degrees.hpp"
#include "harness/stream/covariance_columns.hpp"
#include "harness/stream/log_stream.hpp"
#include "harness/stream/truth_track.hpp"

namespace harness {

namespace {

void check_order(const CsvReader& rows, double t, double last) {
  if (t < last) rows.fail(0, fmt::format("{} s is before {} s, the time of the row before", t, last));
}

std::vector<ForeignEstimates::Pose> read_csv_poses(const std::filesystem::path& file) {
  CsvReader rows(file,
                 {{"t", "x", "y", "theta"}, {"cov_xx", "cov_xy", "cov_xt", "cov_yy", "cov_yt", "cov_tt"}});
  std::vector<ForeignEstimates::Pose> poses;
  while (rows.next()) {
    const double t = rows.number(0);
    if (!poses.empty()) check_order(rows, t, poses.back().pose.t);
    poses.push_back({{t, {rows.number(1), rows.number(2), seif::wrap_angle(rows.number(3))}}, {}});
    if (rows.has_optional() && !rows.is_empty(4)) poses.back().covariance = read_covariance<3>(rows, 4);
  }
  return poses;
}

std::vector<ForeignEstimates::Pose> read_foreign_poses(const std::filesystem::path& file) {
  if (file.extension() == ".csv") return read_csv_poses(file);
  std::vector<ForeignEstimates::Pose> poses;
  for (const TimedPose& pose : read_tum(file)) poses.push_back({pose, {}});
  return poses;
}

using TruthAt = std::function<std::optional<seif::Pose2>(double t)>;

/// The truth from any of the files that may hold it.
TruthAt truth_of_file(const std::filesystem::path& file) {
  constexpr double any_gap = std::numeric_limits<double>::infinity();
  const bool is_folder = std::filesystem::is_directory(file);
  if (!is_folder && file.extension() != ".csv") return truth_from(read_tum(file));
  const auto reader =
      is_folder ? std::make_shared<TruthReader>(file) : std::make_shared<TruthReader>(file, any_gap);
  return [reader](double t) {
    const std::optional<TruePose> pose = reader->at(t);
    return pose ? std::optional(pose->T_world_robot) : std::nullopt;
  };
}

std::optional<double> mean_of_sum(double sum, int count) {
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

void score_foreign_trajectory(const ForeignEstimates& estimates, double rpe_interval, ForeignScore& scored) {
  std::vector<PosePair> pairs;
  double sum = 0.0;
  int count = 0;
  for (const auto& [pose, covariance] : estimates.poses) {
    const std::optional<seif::Pose2> true_pose = estimates.truth(pose.t);
    if (!true_pose) {
      ++scored.poses_without_truth;
      continue;
    }
    pairs.push_back({pose.t, pose.T_world_robot, *true_pose});
    if (!covariance) continue;
    const std::optional<double> value = nees(pose_error(pose.T_world_robot, *true_pose), *covariance);
    if (!value) {
      ++scored.score.improper_beliefs;
      continue;
    }
    sum += *value;
    ++count;
  }
  if (pairs.empty())
    throw BadInput(fmt::format("{}: there is no true pose at any of its times", estimates.name));
  scored.poses = static_cast<int>(pairs.size());
  scored.score.trajectory = absolute_trajectory_error(pairs);
  scored.score.rpe = relative_pose_error(pairs, rpe_interval);
  scored.score.nees_pose = mean_of_sum(sum, count);
}

void score_foreign_map(const ForeignEstimates& estimates, EstimatorScore& score) {
  std::vector<PointPair> points;
  double sum = 0.0;
  int count = 0;
  for (const MapRecord& landmark : estimates.map) {
    const std::vector<PointPair> pair = pair_landmarks(std::span(&landmark, 1), estimates.landmarks);
    points.insert(points.end(), pair.begin(), pair.end());
    if (pair.empty() || !landmark.covariance) continue;
    const auto value = nees(Eigen::Vector2d(pair[0].est_point - pair[0].true_point), *landmark.covariance);
    if (!value) continue;
    sum += *value;
    ++count;
  }
  if (points.empty())
    throw BadInput(fmt::format("{}: none of its landmarks is among the true ones", estimates.name));
  score.landmarks_mapped = static_cast<int>(estimates.map.size());
  score.landmarks_spurious = static_cast<int>(estimates.map.size() - points.size());
  score.landmarks = score_points(points);
  score.nees_landmark = mean_of_sum(sum, count);
}

using ForeignJson = nlohmann::ordered_json;

ForeignJson json_number(const std::optional<double>& value) {
  return value ? ForeignJson(*value) : ForeignJson(nullptr);
}

}  // namespace

TruthAt truth_from(std::vector<TimedPose> poses) {
  struct Rows {
    std::vector<TimedPose> poses;
    std::size_t next = 0;
    TruthTrack track;
  };
  const auto rows = std::make_shared<Rows>();
  rows->poses = std::move(poses);
  return [rows](double t) {
    const std::optional<TruePose> pose = rows->track.at(t, [&]() -> std::optional<TruePose> {
      if (rows->next == rows->poses.size()) return std::nullopt;
      const TimedPose& row = rows->poses[rows->next++];
      return TruePose{.t = row.t, .T_world_robot = row.T_world_robot};
    });
    return pose ? std::optional(pose->T_world_robot) : std::nullopt;
  };
}

ForeignScore score_foreign(const ForeignEstimates& estimates, double rpe_interval) {
  ForeignScore scored;
  scored.score.name = estimates.name;
  if (!estimates.poses.empty()) score_foreign_trajectory(estimates, rpe_interval, scored);
  if (!estimates.map.empty()) score_foreign_map(estimates, scored.score);
  return scored;
}

ForeignScore score_foreign(const ForeignFiles& files, double rpe_interval) {
  ForeignEstimates estimates;
  const std::filesystem::path& named = files.trajectory.empty() ? files.map : files.trajectory;
  estimates.name = named.stem().string();
  if (!files.trajectory.empty()) {
    estimates.poses = read_foreign_poses(files.trajectory);
    estimates.truth = truth_of_file(files.truth);
  }
  if (!files.map.empty()) {
    estimates.map = read_map_file(files.map);
    estimates.landmarks =
        read_landmarks(files.landmarks.empty() ? files.truth / "landmarks.csv" : files.landmarks);
  }
  return score_foreign(estimates, rpe_interval);
}

std::string foreign_board(const ForeignScore& scored) {
  const EstimatorScore& score = scored.score;
  const std::optional<double> turn =
      score.rpe.rotation ? std::optional(degrees_per_radian * *score.rpe.rotation) : std::nullopt;
  std::string text =
      text_table({{"estimator", "landmarks", "map RMSE [m]", "aligned [m]", "ATE [m]", "aligned [m]",
                   "RPE [m]", "RPE [deg]", "NEES pose", "NEES map"},
                  {score.name, score.landmarks_mapped ? fmt::format("{}", *score.landmarks_mapped) : "-",
                   number_cell(score.landmarks.rmse, 3), number_cell(score.landmarks.rmse_aligned, 3),
                   number_cell(score.trajectory.rmse, 3), number_cell(score.trajectory.rmse_aligned, 3),
                   number_cell(score.rpe.translation, 4), number_cell(turn, 3),
                   number_cell(score.nees_pose, 2), number_cell(score.nees_landmark, 2)}});
  if (scored.poses_without_truth > 0)
    text += fmt::format("\n{} of {} poses have no true pose at their time, and were left out\n",
                        scored.poses_without_truth, scored.poses + scored.poses_without_truth);
  if (score.landmarks_spurious.value_or(0) > 0)
    text += fmt::format("\n{} landmarks of the map are not in the world\n", *score.landmarks_spurious);
  if (score.improper_beliefs > 0)
    text += fmt::format("\n{} covariances of poses are not positive definite\n", score.improper_beliefs);
  return text;
}

std::string to_json(const ForeignScore& scored) {
  const EstimatorScore& score = scored.score;
  const ForeignJson json = {
      {"name", score.name},
      {"poses", scored.poses},
      {"poses_without_truth", scored.poses_without_truth},
      {"ate_rmse_m", json_number(score.trajectory.rmse)},
      {"ate_rmse_aligned_m", json_number(score.trajectory.rmse_aligned)},
      {"rpe_trans_m", json_number(score.rpe.translation)},
      {"rpe_rot_rad", json_number(score.rpe.rotation)},
      {"landmarks_mapped",
       score.landmarks_mapped ? ForeignJson(*score.landmarks_mapped) : ForeignJson(nullptr)},
      {"landmarks_spurious",
       score.landmarks_spurious ? ForeignJson(*score.landmarks_spurious) : ForeignJson(nullptr)},
      {"landmark_rmse_m", json_number(score.landmarks.rmse)},
      {"landmark_rmse_aligned_m", json_number(score.landmarks.rmse_aligned)},
      {"nees_pose", json_number(score.nees_pose)},
      {"nees_landmark", json_number(score.nees_landmark)},
      {"improper_beliefs", score.improper_beliefs}};
  return json.dump(2, ' ', false, ForeignJson::error_handler_t::replace) + "\n";
}

}  // namespace harness
