#include "harness/score/score_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <variant>

#include "harness/files/csv_reader.hpp"
#include "harness/recording/step_table.hpp"
#include "harness/score/seen_landmarks.hpp"
#include "harness/statistics/divergence.hpp"
#include "harness/stream/covariance_columns.hpp"
#include "harness/stream/log_stream.hpp"

namespace harness {

namespace {

constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t most_degrees = 1'000'000;  // [-] of one scan

void score_trajectory(const std::filesystem::path& folder, double rpe_interval, bool is_frame_known,
                      EstimatorScore& score) {
  const std::vector<PosePair> poses = read_poses(folder, score.name);
  score.trajectory = absolute_trajectory_error(poses);
  if (!is_frame_known) score.trajectory.rmse.reset();
  score.rpe = relative_pose_error(poses, rpe_interval);
}

/// `truth`: the true landmarks, if `run` knows them.
void score_map(const std::filesystem::path& folder, std::span<const TrueLandmark> truth, const RunScore& run,
               EstimatorScore& score) {
  const ScoredMap map = read_scored_map(folder, score.name);
  const int mapped = static_cast<int>(map.landmarks.size()) + map.duplicates;
  score.landmarks_mapped = mapped;
  score.matched_by = map.matched_by;
  if (!run.landmarks_are_known || map.matched_by == MatchedBy::nothing) return;
  if (map.matched_by == MatchedBy::place)
    score.by_place = count_landmarks(map.landmarks, truth, read_seen_landmarks(folder));
  const std::vector<PointPair> points = pair_landmarks(map.landmarks, truth);
  score.landmarks = score_points(points);
  if (!run.frame_is_known) score.landmarks.rmse.reset();
  score.landmarks_spurious = mapped - static_cast<int>(points.size());
}

void score_associations(const std::filesystem::path& folder, EstimatorScore& score) {
  const std::optional<Associations> associations = read_associations(folder, score.name);
  if (!associations) return;
  const auto share = [](std::int64_t part, std::int64_t whole) {
    return whole > 0 ? std::optional(static_cast<double>(part) / static_cast<double>(whole)) : std::nullopt;
  };
  const auto& [named, left_out, names] = *associations;
  score.associations_left_out = share(left_out, named + left_out);
  if (names) score.associations_right = share(names->right(), named);
}

/// e' P^-1 e of the pose of a row, if truth and covariance are known.
std::optional<double> distance_of(const CsvReader& rows) {
  if (rows.is_empty(step_error_x) || rows.is_empty(step_cov_xx)) return std::nullopt;
  const Eigen::Vector3d error(rows.number(step_error_x), rows.number(step_error_y),
                              rows.number(step_error_theta));
  return squared_distance(error, read_covariance<3>(rows, step_cov_xx));
}

void score_steps(const std::filesystem::path& folder, EstimatorScore& score) {
  CsvReader rows(folder / (score.name + "_steps.csv"), step_columns());
  std::vector<double> blocks_touched;
  std::vector<double> mean_residuals;
  InnovationTest innovations;
  while (rows.next()) {
    const std::int64_t gated_before = score.gated.value_or(0);
    const std::int64_t relocations_before = score.relocations.value_or(0);
    blocks_touched.push_back(rows.number(step_blocks_touched));
    score.active_max = std::max(score.active_max.value_or(0), rows.integer(step_active_landmarks, 0, most));
    score.links = rows.integer(step_links, 0, most);
    score.relocations = rows.integer(step_relocations, 0, most);
    if (!rows.is_empty(step_mean_residual)) mean_residuals.push_back(rows.number(step_mean_residual));
    if (!rows.is_empty(step_anchoring)) score.anchoring = rows.number(step_anchoring);
    if (rows.has_optional()) score.gated = rows.integer(step_gated, 0, most);
    score.links_max = std::max(score.links_max.value_or(0), *score.links);
    if (rows.has_newer()) score.weakened = rows.integer(step_weakened, 0, most);
    if (rows.has_newer() && !rows.is_empty(step_innovation)) {
      const auto degrees = static_cast<int>(rows.integer(step_innovation_degrees, 0, most_degrees));
      innovations.add(rows.number(step_t), rows.number(step_innovation), degrees,
                      *score.gated - gated_before);
    }
    UpdateOfLoss update{
        .t = rows.number(step_t),
        .has_used = !rows.has_newer() || rows.integer(step_innovation_degrees, 0, most_degrees) > 0,
        .left_out = score.gated.value_or(0) - gated_before,
        .relocations = *score.relocations - relocations_before};
    if (update.relocations > 0) update.distance = distance_of(rows);
    score.losses.add(update);
  }
  score.diverged_t = innovations.fired_t();
  score.worst_nis = innovations.worst();
  score.blocks_touched = percentiles(blocks_touched);
  score.mean_residual = percentiles(mean_residuals);
}

void score_times(const std::filesystem::path& folder, EstimatorScore& score) {
  CsvReader rows(folder / (score.name + "_times.csv"),
                 {{"t", "update", "motion", "measurement", "sparsification", "mean_recovery"}, {}});
  std::vector<double> updates;
  std::array<std::vector<double>, stage_count> stages;
  while (rows.next()) {
    updates.push_back(rows.number(1));
    for (int stage = 0; stage < stage_count; ++stage) {
      if (!rows.is_empty(2 + stage))
        stages.at(static_cast<std::size_t>(stage)).push_back(rows.number(2 + stage));
    }
  }
  score.update_us = percentiles(updates);
  std::ranges::transform(stages, score.stage_us.begin(),
                         [](std::vector<double>& us) { return percentiles(us); });
}

/// Computes a mean and keeps the last value.
struct Mean {
  double sum = 0.0;
  int count = 0;
  std::optional<double> last;

  void add(const CsvReader& rows, int column) {
    last.reset();
    if (rows.is_empty(column)) return;
    last = rows.number(column);
    sum += *last;
    ++count;
  }
  std::optional<double> mean() const { return count > 0 ? std::optional(sum / count) : std::nullopt; }
};

/// The scoring times of an estimator at which the true pose is not known.
struct TimesWithoutTruth {
  int count = 0;                  // [-]
  std::optional<double> first_t;  // [s]

  void add(double t) {
    ++count;
    if (!first_t) first_t = t;
  }
};

TimesWithoutTruth score_consistency(const std::filesystem::path& folder, const RunScore& run,
                                    EstimatorScore& score) {
  CsvReader rows(
      folder / (score.name + "_consistency.csv"),
      {{"t", "nees_pose", "nees_landmark", "landmarks_scored", "landmarks_mapped", "memory_bytes"}, {}});
  std::optional<TruthReader> truth;
  if (run.poses_are_known) truth.emplace(folder);
  TimesWithoutTruth without_truth;
  Mean pose;
  Mean landmark;
  while (rows.next()) {
    const double t = rows.number(0);
    score.memory_bytes = rows.integer(5, 0, most);
    const bool is_truth_known = truth && truth->at(t);
    if (!is_truth_known) without_truth.add(t);
    if (!run.frame_is_known) continue;
    pose.add(rows, 1);
    landmark.add(rows, 2);
    // An empty NEES is the belief's fault only if the truth is known.
    if (rows.is_empty(1) && is_truth_known) {
      ++score.improper_beliefs;
      if (!score.improper_t) score.improper_t = t;
    }
    if (pose.last.value_or(0.0) > highest_nees_pose() && !score.diverged_nees_t) score.diverged_nees_t = t;
  }
  score.nees_pose = pose.mean();
  score.nees_pose_final = pose.last;
  score.nees_landmark = landmark.mean();
  score.nees_landmark_final = landmark.last;
  return without_truth;
}

}  // namespace

std::vector<TimedPose> read_tum(const std::filesystem::path& file) {
  CsvReader rows = CsvReader::without_header(file, {{"t", "x", "y", "z", "qx", "qy", "qz", "qw"}, {}});
  std::vector<TimedPose> poses;
  while (rows.next()) {
    if (!poses.empty() && rows.number(0) < poses.back().t)
      rows.fail(
          0, fmt::format("{} s is before {} s, the time of the row before", rows.number(0), poses.back().t));
    const double theta = seif::wrap_angle(2.0 * std::atan2(rows.number(6), rows.number(7)));
    poses.push_back({rows.number(0), {rows.number(1), rows.number(2), theta}});
  }
  return poses;
}

std::vector<TimedPose> read_trajectory(const std::filesystem::path& folder, const std::string& name) {
  return read_tum(folder / (name + ".tum"));
}

std::vector<PosePair> read_poses(const std::filesystem::path& folder, const std::string& name) {
  std::vector<PosePair> poses;
  if (!std::filesystem::exists(folder / "truth.csv")) return poses;
  TruthReader truth(folder);
  for (const TimedPose& pose : read_trajectory(folder, name)) {
    const std::optional<TruePose> true_pose = truth.at(pose.t);
    if (true_pose) poses.push_back({pose.t, pose.T_world_robot, true_pose->T_world_robot});
  }
  return poses;
}

std::vector<MapRecord> read_map_file(const std::filesystem::path& file) {
  CsvReader rows(file, {{"landmark", "x", "y"}, {"cov_xx", "cov_xy", "cov_yy"}});
  std::vector<MapRecord> map;
  while (rows.next()) {
    const std::int64_t id = rows.integer(0, 0, std::numeric_limits<seif::LandmarkId>::max());
    map.push_back({static_cast<seif::LandmarkId>(id), {rows.number(1), rows.number(2)}, {}});
    if (!rows.has_optional() || rows.is_empty(3)) continue;
    map.back().covariance = read_covariance<2>(rows, 3);
  }
  return map;
}

std::vector<MapRecord> read_map(const std::filesystem::path& folder, const std::string& name) {
  return read_map_file(folder / (name + "_map.csv"));
}

std::vector<PointPair> pair_landmarks(std::span<const MapRecord> map, std::span<const TrueLandmark> truth) {
  std::vector<PointPair> points;
  for (const MapRecord& landmark : map) {
    const auto it = std::ranges::lower_bound(truth, landmark.landmark, {}, &TrueLandmark::landmark);
    if (it != truth.end() && it->landmark == landmark.landmark)
      points.push_back({landmark.mean, it->position});
  }
  return points;
}

bool frame_is_known(const std::filesystem::path& folder) {
  LogStream stream(folder);
  if (stream.description().true_start) return true;
  Event first;
  return stream.next(first) && std::visit([](const auto& event) { return event.truth.has_value(); }, first);
}

RunScore score_folder(const std::filesystem::path& folder, std::span<const std::string> estimators,
                      double rpe_interval) {
  RunScore run;
  run.landmarks_are_known = std::filesystem::exists(folder / "landmarks.csv");
  const std::vector<TrueLandmark> landmarks =
      run.landmarks_are_known ? read_landmarks(folder / "landmarks.csv") : std::vector<TrueLandmark>{};
  run.poses_are_known = std::filesystem::exists(folder / "truth.csv");
  run.frame_is_known = run.poses_are_known && frame_is_known(folder);
  run.odometry.name = "odometry";
  score_trajectory(folder, rpe_interval, run.frame_is_known, run.odometry);
  for (const std::string& name : estimators) {
    EstimatorScore score;
    score.name = name;
    score_trajectory(folder, rpe_interval, run.frame_is_known, score);
    score_map(folder, landmarks, run, score);
    score_associations(folder, score);
    score_steps(folder, score);
    score_times(folder, score);
    const TimesWithoutTruth without_truth = score_consistency(folder, run, score);
    if (without_truth.count > run.times_without_truth) {
      run.times_without_truth = without_truth.count;
      run.without_truth_t = without_truth.first_t;
    }
    run.estimators.push_back(std::move(score));
  }
  return run;
}

}  // namespace harness
