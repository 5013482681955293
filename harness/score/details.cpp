#include "harness/score/details.hpp"

#include <cmath>
#include <set>
#include <utility>
#include <variant>

#include "harness/files/csv_reader.hpp"
#include "harness/score/score_folder.hpp"
#include "harness/score/seen_landmarks.hpp"
#include "harness/score/true_names.hpp"
#include "harness/statistics/chi_square.hpp"
#include "harness/stream/log_stream.hpp"

namespace harness {

namespace {

/// What all estimators of a run share.
struct RunFacts {
  std::optional<std::vector<TrueLandmark>> landmarks;  // sorted by id
  std::optional<std::set<seif::LandmarkId>> seen;      // the world's landmarks that appear in any scan
  std::vector<std::size_t> closures;
  bool frame_is_known = false;  // as in RunScore
};

RunFacts read_facts(const std::filesystem::path& folder, double away) {
  LogStream stream(folder);
  RunFacts facts;
  facts.landmarks = stream.description().landmarks;
  SeenLandmarks seen(stream.description());
  std::set<seif::LandmarkId> all;
  std::vector<SeenScan> scans;
  for (Event event; stream.next(event);) {
    const auto* scan = std::get_if<ScanEvent>(&event);
    if (scan == nullptr) continue;
    scans.push_back(seen.of(*scan));
    all.insert(scans.back().landmarks.begin(), scans.back().landmarks.end());
  }
  if (seen.is_known()) facts.seen = std::move(all);
  facts.closures = loop_closures(scans, away);
  facts.frame_is_known = frame_is_known(folder);
  return facts;
}

void score_trajectory(std::span<const PosePair> poses, const DetailChoices& choices, const RunFacts& facts,
                      EstimatorDetails& details) {
  for (const double distance : choices.distances)
    details.rpe.push_back(relative_pose_error_along_path(poses, distance));
  if (!facts.frame_is_known) return;
  std::vector<double> errors;
  for (const PosePair& pair : poses)
    errors.push_back(std::hypot(pair.est_pose.x - pair.true_pose.x, pair.est_pose.y - pair.true_pose.y));
  details.closure_error = closure_response(facts.closures, errors);
}

void score_map(const std::filesystem::path& folder, std::span<const PosePair> poses, const RunFacts& facts,
               EstimatorDetails& details) {
  if (!facts.landmarks) return;
  const ScoredMap scored = read_scored_map(folder, details.name);
  if (scored.matched_by == MatchedBy::nothing) return;
  const std::vector<MapRecord>& map = scored.landmarks;
  details.map = count_landmarks(map, *facts.landmarks, facts.seen);
  details.map->spurious += scored.duplicates;
  details.map->duplicate += scored.duplicates;
  const std::vector<PointPair> points = pair_landmarks(map, *facts.landmarks);
  if (!poses.empty()) details.landmark_rmse_from_robot = rmse_from_robot(points, poses.back());
  // Where they were found by place they are near by definition, so their NEES says nothing.
  if (scored.matched_by == MatchedBy::place || !facts.frame_is_known) return;
  std::vector<double> values;
  for (const MapRecord& landmark : map) {
    const std::vector<PointPair> pair = pair_landmarks({&landmark, 1}, *facts.landmarks);
    if (pair.empty() || !landmark.covariance) continue;
    const Eigen::Vector2d error = pair.front().est_point - pair.front().true_point;
    if (const std::optional<double> value = nees(error, *landmark.covariance)) values.push_back(*value);
  }
  details.landmarks_inside = share_inside(values, chi_square_band(2));
}

void score_consistency(const std::filesystem::path& folder, EstimatorDetails& details) {
  CsvReader rows(
      folder / (details.name + "_consistency.csv"),
      {{"t", "nees_pose", "nees_landmark", "landmarks_scored", "landmarks_mapped", "memory_bytes"}, {}});
  std::vector<double> values;
  while (rows.next()) {
    if (!rows.is_empty(1)) values.push_back(rows.number(1));
  }
  details.poses_scored = values.size();
  details.pose_inside = share_inside(values, chi_square_band(3));
}

}  // namespace

RunDetails score_details(const std::filesystem::path& folder, std::span<const std::string> estimators,
                         const DetailChoices& choices) {
  const RunFacts facts = read_facts(folder, choices.away);
  RunDetails run;
  run.choices = choices;
  run.closures = facts.closures.size();
  run.odometry.name = "odometry";
  score_trajectory(read_poses(folder, run.odometry.name), choices, facts, run.odometry);
  for (const std::string& name : estimators) {
    EstimatorDetails details;
    details.name = name;
    const std::vector<PosePair> poses = read_poses(folder, name);
    score_trajectory(poses, choices, facts, details);
    score_map(folder, poses, facts, details);
    if (facts.frame_is_known)
      score_consistency(choices.consistency.empty() ? folder : choices.consistency, details);
    run.estimators.push_back(std::move(details));
  }
  return run;
}

}  // namespace harness
