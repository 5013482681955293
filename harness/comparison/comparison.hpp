// Estimators compared over runs: each run feeds one stream to all of them, so their values come in pairs.
// Definitions: docs/scores.md.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/run/detailed_run.hpp"
#include "harness/statistics/statistics.hpp"

namespace harness {

/// One run of a comparison: a seed of a world, or a log.
struct ComparedRun {
  std::string name;  // "courtyard-1", or the log's
  RunResult result;
  std::optional<RunDetails> details = {};
};

/// An estimator over the runs that it finished. A score that no run has is empty.
struct EstimatorComparison {
  std::string name;
  int runs = 0;                                  // [-] finished
  int failed = 0;                                // [-] in which it, or the run as a whole, failed
  std::optional<Estimate> landmark_mse;          // [m^2]
  std::optional<double> landmark_mse_median;     // [m^2] of the runs
  std::optional<Estimate> landmark_mse_ratio;    // [-] over the baseline's
  std::optional<Estimate> landmark_aligned;      // [m] RMSE
  std::optional<Estimate> aligned_ratio;         // [-] mean over the runs of the ratio to the baseline's
  std::optional<double> aligned_ratio_median;    // [-]
  std::optional<Estimate> nees_pose;             // [-] at the end
  std::optional<Estimate> nees_landmark;         // [-] at the end
  std::optional<Estimate> nees_from_robot;       // [-] of landmarks as seen from the robot, at the end
  std::optional<Estimate> nis_scan;              // [-] of whole scans
  std::optional<double> nis_scan_inside;         // [-] share, mean over the runs
  std::optional<double> landmarks_missed;        // [-] mean over the runs, as are the next two
  std::optional<double> landmarks_spurious;      // [-]
  std::optional<double> landmarks_duplicate;     // [-]
  std::optional<Estimate> links;                 // [-] at the end
  std::optional<double> links_max;               // [-] in any run
  std::optional<double> relocations_per_update;  // [-] nothing if there were none
  std::optional<double> update_p50_us;           // [us] mean over the runs
  std::optional<double> update_p99_us;           // [us] mean over the runs
};

struct Comparison {
  std::string name;      // of the world, or of the logs
  std::string baseline;  // the estimator to which ratios are taken
  bool interrupted = false;
  std::vector<ComparedRun> runs;                // that came to an end
  std::vector<EstimatorComparison> estimators;  // in the order in which the runs have them
};

/// Fills in `estimators` from `runs`.
void compare_estimators(Comparison& comparison);

/// A line for each run and each estimator in it that failed.
std::string failures_of(const Comparison& comparison);

/// The exit code of a command that compares: the worst of the runs', or 130 if it was interrupted.
int exit_code(const Comparison& comparison);

/// The whole comparison with every run's summary.
std::string to_json(const Comparison& comparison);

/// As tables for people, with the failures below.
std::string comparison_board(const Comparison& comparison);

}  // namespace harness
