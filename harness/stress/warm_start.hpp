// Filters that have mapped a world before anything is measured: the robot drives the whole round with the kinematic
// engine, with the same sensors, rates and noise as afterwards.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/run/live_loop.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

struct WarmStart {
  std::unique_ptr<Believers> believers;  // those that are left
  /// The estimators that took too long: the name, and how far they came.
  struct GivenUp {
    std::string name;
    std::string why;
  };
  std::vector<GivenUp> given_up;
  seif::Pose2 T_world_robot;   // where the robot is, truly
  std::int64_t landmarks = 0;  // [-] that were seen
  std::int64_t updates = 0;    // [-]
};

struct WarmStartLimits {
  double length = 0.0;      // [m] of the round
  double slowest_ms = 0.0;  // [ms] an update that takes longer, on the average of the last hundred or so
};

/// Drives once round. Ends early if `stop` is set.
WarmStart warm_start(const worlds::World& world, const seif::Registry& registry,
                     const WarmStartLimits& limits, const std::atomic<bool>& stop,
                     const std::function<void(double t)>& progress);

/// Drives on along the round for `updates` updates, with the same engine, from the start pose of `world`.
/// Returns the final pose.
seif::Pose2 drive_on(const worlds::World& world, Believers& believers, std::int64_t updates,
                     const std::atomic<bool>& stop);

}  // namespace harness
