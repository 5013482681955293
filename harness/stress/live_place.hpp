// One place on the round of a stress test: everything live in Bullet, with a clock for each stage.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "harness/run/live_loop.hpp"
#include "harness/stream/run_listener.hpp"
#include "harness/stress/stress.hpp"
#include "worlds/world.hpp"

namespace harness {

/// The measurements at one place, or of all places so far.
struct LiveSamples {
  /// Reserves and touches memory for this number of updates, so that taking samples does not look like
  /// growth.
  LiveSamples(std::int64_t expected_updates, const worlds::World& world);

  void add(const LiveSamples& other);

  std::vector<double> step_us;    // of physics steps
  std::vector<double> scan_us;    // of scans
  std::vector<double> update_us;  // of the estimator's updates, if there is an estimator
  std::vector<double> rest_us;    // of the rest of a cycle, from scan to scan
  std::vector<double> cycle_us;   // of whole cycles
  std::vector<double> blocks;     // [-] touched by each update
  sim::SimulatorCounts counts;
  std::int64_t updates = 0;
  double t = 0.0;                       // [s] simulated
  double wall_s = 0.0;                  // [s] real time
  double process_bytes = 0.0;           // resident at the end, with the simulator
  double growth_bytes = 0.0;            // increase of process_bytes after the first fifth
  double build_s = 0.0;                 // [s] time to build the simulator
  std::optional<double> nees_pose;      // [-] at the end, if the filter can tell it
  std::optional<double> nees_landmark;  // [-] at the end, if asked for
  seif::Pose2 T_world_robot;            // robot's pose at the end
};

struct LivePlace {
  worlds::World world;           // the robot starts at this place
  std::int64_t updates = 0;      // [-] to be measured
  std::filesystem::path folder;  // for the record
  bool has_covariances = false;  // landmarks get a NEES at the end
  bool quiet = false;
};

/// Measures at one place. Ends early if `stop` is set.
LiveSamples measure_place(const LivePlace& place, Believers& believers,
                          const std::function<void()>& after_each_update, const std::atomic<bool>& stop);

}  // namespace harness
