// Lets filters map a world before the measurement. The robot drives one whole round in the engine without
// contacts, with the same sensors, rates and noise as in the measurement.
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
  std::unique_ptr<Believers> believers;  // those that were not given up
  /// An estimator that took too long, and how far it came.
  struct GivenUp {
    std::string name;
    std::string why;
  };
  std::vector<GivenUp> given_up;
  seif::Pose2 T_world_robot;   // true pose of the robot
  std::int64_t landmarks = 0;  // [-] seen so far
  std::int64_t updates = 0;    // [-]
};

struct WarmStartLimits {
  double length = 0.0;      // [m] length of the round
  double slowest_ms = 0.0;  // [ms] mean of the last hundred updates or so that makes an estimator give up
};

/// Drives one round. Ends early if `stop` is set.
WarmStart warm_start(const worlds::World& world, const seif::Registry& registry,
                     const WarmStartLimits& limits, const std::atomic<bool>& stop,
                     const std::function<void(double t)>& progress);

/// Drives on along the round for this number of updates, in the same engine, from the start pose in `world`.
/// Returns the robot's pose at the end.
seif::Pose2 drive_on(const worlds::World& world, Believers& believers, std::int64_t updates,
                     const std::atomic<bool>& stop);

}  // namespace harness
