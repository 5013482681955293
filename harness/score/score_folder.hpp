// The score of a run, from the files of its folder and nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/score/score.hpp"
#include "harness/stream/run_listener.hpp"

namespace harness {

/// A score is empty if the truth or the filter's covariance is not known.
struct EstimatorScore {
  std::string name;
  std::optional<int> landmarks_mapped;        // [-]
  std::optional<int> landmarks_spurious;      // [-] in the map, and not in the world
  PointScore landmarks;                       // [m]
  PointScore trajectory;                      // [m] ATE
  RelativePoseError rpe;                      // [m, rad]
  std::optional<double> nees_pose;            // [-] mean over the scoring times
  std::optional<double> nees_pose_final;      // [-]
  std::optional<double> nees_landmark;        // [-] mean over the scoring times
  std::optional<double> nees_landmark_final;  // [-]
  int improper_beliefs = 0;               // [-] scoring times with a matrix that was not positive definite
  std::optional<double> improper_t;       // [s] the first of them
  std::optional<double> diverged_t;       // [s] when the test of innovations first fired
  std::optional<double> worst_nis;        // [-] the largest over a window of scans
  std::optional<double> diverged_nees_t;  // [s] the first scoring time with too high a NEES of the pose
  std::optional<Percentiles> update_us;   // [us]
  std::array<std::optional<Percentiles>, stage_count> stage_us;  // [us]
  std::optional<Percentiles> blocks_touched;                     // [-] by an update
  std::optional<std::int64_t> links;                             // [-] after the last update
  std::optional<std::int64_t> links_max;                         // [-]
  std::optional<std::int64_t> relocations;                       // [-] in all
  std::optional<std::int64_t> gated;                             // [-] observations left out in all
  std::optional<std::int64_t> weakened;  // [-] observations that got less weight, in all
  std::optional<double>
      associations_right;  // [-] share of correct ones, if the estimator associates by itself
  std::optional<double> associations_left_out;  // [-] share of the observations that it ignored
  std::optional<Percentiles> mean_residual;     // [-] after an update
  std::optional<double> anchoring;              // [nat] left out in all
  std::optional<std::int64_t> active_max;       // [-]
  std::optional<std::int64_t> memory_bytes;     // [byte] at the end
};

struct TimedPose {
  double t = 0.0;  // [s]
  seif::Pose2 T_world_robot;
};

struct RunScore {
  EstimatorScore odometry;  // dead reckoning; the trajectory alone
  std::vector<EstimatorScore> estimators;
};

// These throw BadInput if a file is missing or broken.

RunScore score_folder(const std::filesystem::path& folder, std::span<const std::string> estimators,
                      double rpe_interval);

/// The poses of NAME.tum.
std::vector<TimedPose> read_trajectory(const std::filesystem::path& folder, const std::string& name);

/// The poses of NAME.tum beside the truth, where that is known.
std::vector<PosePair> read_poses(const std::filesystem::path& folder, const std::string& name);

/// The landmarks of NAME_map.csv.
std::vector<MapRecord> read_map(const std::filesystem::path& folder, const std::string& name);

/// The landmarks of a map that the world has too, beside the truth, which is sorted by id.
std::vector<PointPair> pair_landmarks(std::span<const MapRecord> map, std::span<const TrueLandmark> truth);

}  // namespace harness
