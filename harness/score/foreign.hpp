// Scores what any other program has estimated, from files of its own.
#pragma once

#include <filesystem>
#include <string>

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

/// Scores a trajectory, a map, or both. The name is that of the file. `rpe_interval` [s] is that of the relative
/// pose error. Throws BadInput for a file that is missing or broken, and if nothing can be compared.
ForeignScore score_foreign(const ForeignFiles& files, double rpe_interval);

std::string foreign_board(const ForeignScore& scored);

/// With the keys of an estimator in summary.json.
std::string to_json(const ForeignScore& scored);

}  // namespace harness
