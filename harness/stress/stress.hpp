// The cost of everything together, in worlds of the same density with a hundred to a million landmarks.
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
  std::int64_t updates = 1'000;                                         // [-] measured
  /// [-] places spread evenly along the second round, each with an equal share of the updates. The cost at a
  /// place depends on how the tree of the map happens to be divided there.
  std::int64_t places = 10;
  double slowest_ms = 50.0;  // [ms] limit of the mean update time in a warm start
  std::map<std::string, std::int64_t> most_landmarks = {
      {"ekf", 5'000}, {"eif", 500}, {"batch", 50'000}};  // by estimator
  /// [-] landmarks of a map up to which landmarks get a NEES. Their covariances need a factor of the filter's
  /// whole matrix: with a million landmarks it takes more than 20 GB.
  std::int64_t covariances_up_to = 200'000;
  /// The others' map errors are compared with that of this estimator. It runs on the same stream, and has no
  /// times and no blocks. Empty: none.
  std::string reference;
  std::vector<std::string> overrides;  // for the world files
  std::filesystem::path folder;        // it gets a folder for each row, and in it one for each estimator
  bool quiet = false;
  std::function<void()> after_each_update = [] {};  // called after each measured update
};

/// An estimator with a full map.
struct StressEstimator {
  std::string name;
  std::string skipped;  // why it did not run; empty: it did run
  std::int64_t landmarks = 0;
  std::optional<Percentiles> update_us;
  std::optional<Percentiles> blocks;
  double bytes = 0.0;                    // [byte] of the estimator's state
  std::optional<double> map_read_s;      // [s] to read the mean of every landmark
  std::optional<double> map_rmse;        // [m] aligned
  std::optional<double> over_reference;  // [-] map_rmse divided by that of the reference
  std::optional<double> nees_pose;       // [-]
  std::optional<double> nees_landmark;   // [-] missing for a map above covariances_up_to
};

/// The results for one number of landmarks.
struct StressRow {
  std::int64_t landmarks = 0;            // [-] in the world
  double load_s = 0.0;                   // [s] to read the file and place the landmarks
  double build_s = 0.0;                  // [s] to build the simulator
  double warm_s = 0.0;                   // [s] duration of the warm start
  std::int64_t warm_updates = 0;         // [-]
  std::int64_t landmarks_seen = 0;       // [-] in the warm start
  std::int64_t updates = 0;              // [-] measured
  std::optional<Percentiles> step_us;    // of a physics step
  std::optional<Percentiles> scan_us;    // of a scan
  std::optional<Percentiles> rest_us;    // of recording, odometry and steering, from scan to scan
  std::optional<Percentiles> second_us;  // of a simulated second: whole cycles times the scan rate
  double realtime_factor = 0.0;
  sim::SimulatorCounts counts;        // of the measured part
  double process_bytes = 0.0;         // resident
  double bytes_by_landmark = 0.0;     // increase of resident memory, divided by the number of landmarks
  double growth_bytes_by_hour = 0.0;  // of resident memory, in the last four fifths of the measured part
  std::vector<StressEstimator> estimators;
};

struct StressResult {
  std::vector<StressRow> rows;
  bool interrupted = false;
};

/// Measures row by row. Throws BadInput if a world cannot be loaded.
StressResult stress(const StressPlan& plan, const seif::Registry& registry);

/// Measures one row: loads the world, lets the filters map it, and measures.
StressRow stress_row(const StressPlan& plan, const seif::Registry& registry, const std::atomic<bool>& stop);

}  // namespace harness
