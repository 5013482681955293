// Scores what any other program has estimated, from files of its own.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/score/score_folder.hpp"

namespace harness {

struct ForeignFiles {
  /// A TUM file, or a CSV file with t,x,y,theta and, if its program knows it, the covariance
  /// cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt [m, rad].
  std::filesystem::path trajectory = {};
  std::filesystem::path map = {};  // CSV: landmark,x,y and, if it is known, cov_xx,cov_xy,cov_yy; empty: none
  std::filesystem::path truth = {};      // the folder of a log or of a run, its truth.csv, or a TUM file
  std::filesystem::path landmarks = {};  // CSV: landmark,x,y; empty: those of the folder
};

struct ForeignScore {
  /// Without costs. The NEES of the pose is the mean over all poses with a covariance, that of the landmarks the
  /// mean over the map.
  EstimatorScore score;
  int poses = 0;                // [-] of the trajectory, with a known true pose
  int poses_without_truth = 0;  // [-]
};

/// A trajectory and a map, either of which may be empty, and what they are compared with.
struct ForeignEstimates {
  struct Pose {
    TimedPose pose;
    std::optional<Eigen::Matrix3d> covariance;  // (3 x 3) [m, rad]
  };
  std::string name;
  std::vector<Pose> poses;  // in the order of time
  std::vector<MapRecord> map;
  std::vector<TrueLandmark> landmarks;  // sorted by id
  /// The true pose at a time [s]; nothing if it is not known. Called in the order of time.
  std::function<std::optional<seif::Pose2>(double t)> truth;
};

/// Throws BadInput if a trajectory or a map is there, and nothing of it can be compared. `rpe_interval` [s] is that
/// of the relative pose error.
ForeignScore score_foreign(const ForeignEstimates& estimates, double rpe_interval);

/// The true pose between these poses, which are in the order of time.
std::function<std::optional<seif::Pose2>(double t)> truth_from(std::vector<TimedPose> poses);

/// Scores a trajectory, a map, or both. The name is that of the file. Throws BadInput for a file that is missing or broken, too.
ForeignScore score_foreign(const ForeignFiles& files, double rpe_interval);

std::string foreign_board(const ForeignScore& scored);

/// With the keys of an estimator in summary.json.
std::string to_json(const ForeignScore& scored);

}  // namespace harness
