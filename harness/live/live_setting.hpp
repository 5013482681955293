// What does not move in a live run: the world, the robot's shape, the estimators with their options.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/run/live_loop.hpp"
#include "harness/stream/log_description.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

/// What a page may do to the run, and why it may not do the rest.
struct LiveAbilities {
  bool world = false;    // drive, kidnap, sensors, and things put into the world
  bool control = false;  // pause, steps, speed, back, options, saving
  std::string why_not;
};

/// The run that a page is told about.
struct LiveSubject {
  const worlds::World& world;
  bool knows_world = true;  // false: the log of something else; only estimators and film are of the world
  const LogDescription& log;
  const Believers& believers;
  const seif::Registry& registry;
  LiveAbilities abilities;
};

/// Ready for the pages.
struct LiveSetting {
  std::uint64_t epoch = 0;
  std::uint64_t version = 0;         // one more each time that something was put into the world
  std::string hello;                 // JSON
  std::vector<float> solids;         // 19 for each: T_world_solid (4 x 4, column-major), size [m]
  std::vector<std::uint32_t> tints;  // 0xRRGGBB of each solid
  std::vector<std::uint32_t> post_ids;
  std::vector<float> posts;  // x, y, radius of each true landmark [m]
  std::vector<std::string> estimators;
};

/// `t` [s] is the present: things that appear later are left out.
LiveSetting live_setting(const LiveSubject& subject, double t, std::uint64_t epoch, std::uint64_t version);

}  // namespace harness
