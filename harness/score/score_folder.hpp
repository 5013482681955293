// The score of a run, from the files of its folder only.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/score/map_counts.hpp"
#include "harness/score/score.hpp"
#include "harness/score/true_names.hpp"
#include "harness/statistics/losses.hpp"
#include "harness/stream/run_listener.hpp"

namespace harness {

/// A value is empty if it is not available: the truth or the filter's covariance is not known.
struct EstimatorScore {
  std::string name;
  std::optional<int> landmarks_mapped;        // [-]
  std::optional<int> landmarks_spurious;      // [-] landmarks in the map that the world does not have
  MatchedBy matched_by = MatchedBy::id;       // how the landmarks of the map were found in the world
  std::optional<MapCounts> by_place;          // [-] if they were found by place, and the world is known
  PointScore landmarks;                       // [m]
  PointScore trajectory;                      // [m] absolute trajectory error
  RelativePoseError rpe;                      // [m, rad]
  std::optional<double> nees_pose;            // [-] mean over the scoring times
  std::optional<double> nees_pose_final;      // [-]
  std::optional<double> nees_landmark;        // [-] mean over the scoring times
  std::optional<double> nees_landmark_final;  // [-]
  int improper_beliefs = 0;                   // [-] scoring times without a positive definite covariance
  std::optional<double> improper_t;           // [s] the first of these times
  std::optional<double> diverged_t;           // [s] the innovation test first fired
  std::optional<double> worst_nis;            // [-] largest normalised innovation squared of a window
  std::optional<double> diverged_nees_t;      // [s] first scoring time with too high a NEES of the pose
  std::optional<Percentiles> update_us;       // [us]
  std::array<std::optional<Percentiles>, stage_count> stage_us;  // [us]
  std::optional<Percentiles> blocks_touched;                     // [-] in one update
  std::optional<std::int64_t> links;                             // [-] after the last update
  std::optional<std::int64_t> links_max;                         // [-]
  std::optional<std::int64_t> relocations;                       // [-] total of the run
  Losses losses;                                                 // of its place, and how it was found again
  std::optional<std::int64_t> gated;                             // [-] observations left out by the gate
  std::optional<std::int64_t> weakened;                          // [-] observations with reduced weight
  std::optional<double> associations_right;     // [-] share of the estimator's own associations
  std::optional<double> associations_left_out;  // [-] share of the observations left without landmark
  std::optional<Percentiles> mean_residual;     // [-] after an update
  std::optional<double> anchoring;              // [nat] discarded by sparsification, total of the run
  std::optional<std::int64_t> active_max;       // [-]
  std::optional<std::int64_t> memory_bytes;     // [byte] when the run ends
};

struct TimedPose {
  double t = 0.0;  // [s]
  seif::Pose2 T_world_robot;
};

struct RunScore {
  EstimatorScore odometry;  // dead reckoning: its trajectory only
  std::vector<EstimatorScore> estimators;
  bool landmarks_are_known = false;  // the true ones
  bool poses_are_known = false;      // the true ones, at some time
  /// The start estimate can be compared with the truth. Otherwise nobody knows how the estimators' frame lies in
  /// that of the truth: errors without alignment, and the NEES, are not available.
  bool frame_is_known = false;
  int times_without_truth = 0;            // [-] scoring times at which the true pose is not known
  std::optional<double> without_truth_t;  // [s] the first of these times
};

// These functions throw BadInput if a file is missing or broken.

RunScore score_folder(const std::filesystem::path& folder, std::span<const std::string> estimators,
                      double rpe_interval);

/// True if the true pose is known at the start of a log, or at its first event.
bool frame_is_known(const std::filesystem::path& folder);

/// The poses of a TUM file, which must be in the order of time.
std::vector<TimedPose> read_tum(const std::filesystem::path& file);

/// The poses of `NAME.tum`.
std::vector<TimedPose> read_trajectory(const std::filesystem::path& folder, const std::string& name);

/// The poses of `NAME.tum`, each with the true pose at its time. Poses without a known true pose are left
/// out.
std::vector<PosePair> read_poses(const std::filesystem::path& folder, const std::string& name);

/// The landmarks of a file like `NAME_map.csv`.
std::vector<MapRecord> read_map_file(const std::filesystem::path& file);

/// The landmarks of `NAME_map.csv`.
std::vector<MapRecord> read_map(const std::filesystem::path& folder, const std::string& name);

/// The landmarks that both the map and the world have, each with its true position. `truth` is sorted by id.
std::vector<PointPair> pair_landmarks(std::span<const MapRecord> map, std::span<const TrueLandmark> truth);

}  // namespace harness
