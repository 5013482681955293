// A run that is ready to start: a world or a log, and the estimators.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "harness/readers/open_log.hpp"
#include "harness/run/run.hpp"
#include "seif/registry.hpp"
#include "sim/simulator.hpp"
#include "worlds/world.hpp"

namespace harness {

/// The caller fills in the plan's folder and whether the run is quiet.
struct PreparedRun {
  std::unique_ptr<Believers> believers;  // on the heap: the stream may keep a reference, to steer by them
  std::unique_ptr<Stream> stream;
  const LogDescription* log = nullptr;  // the stream's own
  RunPlan plan;
};

/// Both functions throw BadInput if the log cannot be read or an estimator cannot be made. If the observations
/// name no landmark, estimators that cannot do without are left out (without_names.hpp); throws BadInput if none
/// is left.
PreparedRun prepare_run(const worlds::World& world, const seif::Registry& registry);
/// The same in an existing simulator of this world. The stream is a SimulatedStream.
PreparedRun prepare_run(const worlds::World& world, const seif::Registry& registry,
                        std::unique_ptr<sim::Simulator> simulator);

/// Throws BadInput if the world has several robots: `command` [seifbed ...] is for one.
void refuse_team(const worlds::World& world, const std::string& command);

/// Estimators, scoring and seed come from `world`; the rest is recorded.
PreparedRun prepare_replay(const LogChoice& log, const worlds::World& world, const seif::Registry& registry);
PreparedRun prepare_replay(const std::filesystem::path& log, const worlds::World& world,
                           const seif::Registry& registry);

/// Erases the estimators from the world that are not among the believers.
void leave_out_missing(worlds::World& world, const Believers& believers);

RunResult execute(PreparedRun& run, RunListener* follower = nullptr);

/// Runs quietly in a temporary folder, which is then deleted.
RunResult execute_in_passing(PreparedRun& run, RunListener* follower = nullptr);

/// Writes world.yaml and the files that it needs to the run folder, so that the world can be run from there.
void write_world(const std::filesystem::path& folder, const worlds::World& world, std::string resolved);

/// Writes the settings to the folder of a replay: as world.yaml if the log has a world.yaml, otherwise as
/// replay.yaml.
void write_replayed_world(const std::filesystem::path& folder, const std::filesystem::path& log,
                          const std::string& resolved);

}  // namespace harness
