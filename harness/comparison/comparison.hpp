// Compares estimators over runs. Each run feeds one stream to all estimators, so their values come in pairs.
// Definitions: docs/scores.md.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/files/text_table.hpp"
#include "harness/run/detailed_run.hpp"
#include "harness/statistics/statistics.hpp"

namespace harness {

/// One run of a comparison: one seed of a world, or one log.
struct ComparedRun {
  std::string name;  // "courtyard-1", or the name of the log
  RunResult result;
  std::optional<RunDetails> details = {};
};

/// Statistics of an estimator over the runs that it finished. A value that no run has is empty.
struct EstimatorComparison {
  std::string name;
  int runs = 0;                                // [-] finished
  int failed = 0;                              // [-] runs in which the estimator or the whole run failed
  std::optional<Estimate> landmark_mse;        // [m^2]
  std::optional<double> landmark_mse_median;   // [m^2] median over the runs
  std::optional<Estimate> landmark_mse_ratio;  // [-] to the baseline's, geometric mean over the runs
  std::optional<Estimate> landmark_mse_ratio_of_means;  // [-] mean over the runs, to the baseline's mean
  std::optional<Estimate> landmark_aligned;             // [m] RMSE
  std::optional<Estimate> aligned_ratio;                // [-] to the baseline's, geometric mean over the runs
  std::optional<double> aligned_ratio_median;           // [-]
  std::optional<Estimate> nees_pose;                    // [-] when the run ends
  std::optional<Estimate> nees_landmark;                // [-] when the run ends
  std::optional<Estimate> nees_from_robot;       // [-] of landmarks as seen from the robot, when the run ends
  std::optional<Estimate> nis_scan;              // [-] for whole scans
  std::optional<double> nis_scan_inside;         // [-] share of scans inside their band, mean over runs
  std::optional<double> landmarks_missed;        // [-] mean over the runs, as for the next two
  std::optional<double> landmarks_spurious;      // [-]
  std::optional<double> landmarks_duplicate;     // [-]
  std::optional<Estimate> links;                 // [-] when the run ends
  std::optional<double> links_max;               // [-] maximum over the runs
  std::optional<double> relocations_per_update;  // [-] empty: there were none
  int losses = 0;                                // [-] of the place, in all runs, as for the next two
  int relocalised = 0;                           // [-]
  int relocalised_wrongly = 0;                   // [-]
  std::optional<double> lost_s;                  // [s] mean over the runs in which it was lost
  std::optional<double> update_p50_us;           // [us] mean over the runs
  std::optional<double> update_p99_us;           // [us] mean over the runs
};

struct Comparison {
  std::string name;      // name of the world, or of the logs
  std::string baseline;  // the estimator that ratios are relative to
  bool interrupted = false;
  std::vector<ComparedRun> runs;                // completed runs
  std::vector<EstimatorComparison> estimators;  // in the order of the runs
};

/// Computes `estimators` from `runs`.
void compare_estimators(Comparison& comparison);

/// One line for each failed run and each estimator that failed in a run.
std::string failures_of(const Comparison& comparison);

/// The exit code of a command that compares: the worst of the runs' codes, or 130 if it was interrupted.
int exit_code(const Comparison& comparison);

/// The whole comparison as JSON, with the summary of every run.
std::string to_json(const Comparison& comparison);

/// The tables of the comparison: errors, consistency, map and cost.
std::vector<std::vector<TextRow>> comparison_tables(const Comparison& comparison);

/// The comparison as tables to read in a terminal, with the failures below.
std::string comparison_board(const Comparison& comparison);

}  // namespace harness
