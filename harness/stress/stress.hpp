// The cost of everything together in worlds of one density, from a hundred landmarks to a million.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/score/score.hpp"
#include "harness/stress/stress_world.hpp"
#include "seif/registry.hpp"
#include "sim/simulator.hpp"

namespace harness {

struct StressPlan {
  StressWorldSpec world;  // its number of landmarks changes from row to row
  std::vector<std::int64_t> landmarks = {100, 1'000, 10'000, 100'000};  // ascending
  std::int64_t updates = 1'000;                                         // [-] that are measured
  /// [-] Evenly along the second round, with a share of the updates at each: the cost at one place depends on
  /// how the tree of the map is cut there.
  std::int64_t places = 10;
  double slowest_ms = 50.0;  // [ms] for an update in a warm start, on the average
  std::map<std::string, std::int64_t> most_landmarks = {{"ekf", 5'000}, {"eif", 500}};  // by estimator
  std::int64_t most_scored = 20'000;   // [-] landmarks in a map whose covariances are scored
  std::vector<std::string> overrides;  // of the world files
  std::filesystem::path folder;        // in it one folder for each row, and in these one for each estimator
  bool quiet = false;
  std::function<void()> after_each_update = [] {};  // that is measured
};

/// An estimator with a full map.
struct StressEstimator {
  std::string name;
  std::string skipped;  // why it did not run; empty: it did
  std::int64_t landmarks = 0;
  std::optional<Percentiles> update_us;
  std::optional<Percentiles> blocks;
  double bytes = 0.0;                   // [byte] of its state
  std::optional<double> map_rmse;       // [m] aligned
  std::optional<double> nees_pose;      // [-]
  std::optional<double> nees_landmark;  // [-]
};

/// One number of landmarks.
struct StressRow {
  std::int64_t landmarks = 0;            // [-] in the world
  double load_s = 0.0;                   // [s] reading the file and placing the landmarks
  double build_s = 0.0;                  // [s] building the simulator
  double warm_s = 0.0;                   // [s] the warm start took
  std::int64_t warm_updates = 0;         // [-]
  std::int64_t landmarks_seen = 0;       // [-] in it
  std::int64_t updates = 0;              // [-] measured
  std::optional<Percentiles> step_us;    // a physics step
  std::optional<Percentiles> scan_us;    // a scan
  std::optional<Percentiles> rest_us;    // recording, odometry and steering, from scan to scan
  std::optional<Percentiles> second_us;  // a simulated second: everything, from scan to scan, times the rate
  double realtime_factor = 0.0;
  sim::SimulatorCounts counts;        // of the measured part
  double process_bytes = 0.0;         // resident
  double bytes_by_landmark = 0.0;     // resident beyond what it was before, over the landmarks
  double growth_bytes_by_hour = 0.0;  // resident, of the last four fifths of the measured part
  std::vector<StressEstimator> estimators;
};

struct StressResult {
  std::vector<StressRow> rows;
  bool interrupted = false;
};

/// Measures row by row. Throws BadInput if a world cannot be loaded.
StressResult stress(const StressPlan& plan, const seif::Registry& registry);

/// One row: loads the world, has it mapped, measures.
StressRow stress_row(const StressPlan& plan, const seif::Registry& registry, const std::atomic<bool>& stop);

}  // namespace harness
