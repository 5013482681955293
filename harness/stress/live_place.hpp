// One place on the round of a stress test: everything live in Bullet, each stage with its clock.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "harness/run/live_loop.hpp"
#include "harness/stream/run_listener.hpp"
#include "harness/stress/stress.hpp"
#include "worlds/world.hpp"

namespace harness {

/// The measurements at one place, or at all places so far.
struct LiveSamples {
  /// Reserves and touches memory for this many updates: taking samples must not look like growth.
  LiveSamples(std::int64_t expected_updates, const worlds::World& world);

  void add(const LiveSamples& other);

  std::vector<double> step_us;    // physics steps
  std::vector<double> scan_us;    // scans
  std::vector<double> update_us;  // of the estimator, if there is one
  std::vector<double> rest_us;    // rest of a cycle from scan to scan: everything else
  std::vector<double> cycle_us;   // whole cycles
  std::vector<double> blocks;     // [-] touched by each update
  sim::SimulatorCounts counts;
  std::int64_t updates = 0;
  double t = 0.0;              // [s] simulated
  double wall_s = 0.0;         // [s] it took
  double process_bytes = 0.0;  // resident at the end, with the simulator
  double growth_bytes = 0.0;   // of these, after the first fifth
  double build_s = 0.0;        // [s] building the simulator took
  ConsistencyRecord last;      // the score at the end, if it was asked for
  seif::Pose2 T_world_robot;   // where the robot is then
};

struct LivePlace {
  worlds::World world;           // in which the robot starts there
  std::int64_t updates = 0;      // [-] to be measured
  std::filesystem::path folder;  // of the record
  bool is_scored = false;        // at the end
  bool quiet = false;
};

/// Ends early if `stop` is set.
LiveSamples measure_place(const LivePlace& place, Believers& believers,
                          const std::function<void()>& after_each_update, const std::atomic<bool>& stop);

}  // namespace harness
