// A run before its first event: a world or a log, with the estimators that it is to feed.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "harness/readers/open_log.hpp"
#include "harness/run/run.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

/// Whoever prepares a run fills in the plan's folder and whether it is quiet.
struct PreparedRun {
  std::unique_ptr<Believers> believers;  // in a place of its own: the stream may steer by them
  std::unique_ptr<Stream> stream;
  const LogDescription* log = nullptr;  // the stream's
  RunPlan plan;
};

/// These two throw BadInput if the log cannot be read or an estimator cannot be made.
PreparedRun prepare_run(const worlds::World& world, const seif::Registry& registry);

/// Estimators, scoring and seed are the world's; the rest is recorded. Throws BadInput for a log whose
/// observations do not name their landmark and an estimator that needs that, too.
PreparedRun prepare_replay(const LogChoice& log, const worlds::World& world, const seif::Registry& registry);
PreparedRun prepare_replay(const std::filesystem::path& log, const worlds::World& world,
                           const seif::Registry& registry);

RunResult execute(PreparedRun& run, RunListener* follower = nullptr);

/// Runs quietly in a folder of its own, which goes afterwards.
RunResult execute_in_passing(PreparedRun& run, RunListener* follower = nullptr);

/// Writes world.yaml to the folder of a run, and beside it what it needs, so that it runs again from there.
void write_world(const std::filesystem::path& folder, const worlds::World& world, std::string resolved);

/// Writes world.yaml to the folder of a replay, where the log has one; else replay.yaml.
void write_replayed_world(const std::filesystem::path& folder, const std::filesystem::path& log,
                          const std::string& resolved);

}  // namespace harness
