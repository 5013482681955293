#include "harness/run/prepared_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/heard_packets.hpp"
#include "harness/run/replay_settings.hpp"
#include "harness/run/without_names.hpp"
#include "harness/simulation/simulated_stream.hpp"
#include "worlds/document.hpp"
#include "worlds/merge.hpp"

namespace harness {

namespace {

/// The file names of commands in the run folder; its world.yaml refers to them.
constexpr const char* commands_file = "commands.csv";
constexpr const char* takeover_file = "takeover.csv";

/// A file that a world names.
struct NamedFile {
  std::string key;             // where the world names it
  std::filesystem::path from;  // where it is
  std::string name;            // in the run folder
};

void add_files(std::vector<NamedFile>& files, const worlds::Drive& drive, const std::string& key,
               const std::string& prefix) {
  if (drive.mode == worlds::DriveMode::commands)
    files.push_back({key + ".file", drive.commands_file, prefix + commands_file});
  if (!drive.takeover_file.empty())
    files.push_back({key + ".takeover_file", drive.takeover_file, prefix + takeover_file});
}

std::vector<NamedFile> files_of(const worlds::World& world) {
  std::vector<NamedFile> files;
  add_files(files, world.drive, "drive", "");
  for (std::size_t i = 0; i < world.robots.size(); ++i)
    add_files(files, world.robots[i].drive, fmt::format("robots.{}.drive", i), world.robots[i].name + "_");
  return files;
}

template <class SomeStream>
void set_stream(PreparedRun& run, std::unique_ptr<SomeStream> stream) {
  run.log = &stream->description();
  run.stream = std::move(stream);
}

void set_estimators(PreparedRun& run, const worlds::World& world, const seif::Registry& registry,
                    AbleEstimators able) {
  run.believers->estimators = make_estimators(registry, able.choices, *run.log, world.seed);
  run.plan.notes = std::move(able.notes);
  run.plan.seed = world.seed;
  run.plan.scoring = world.scoring;
  run.plan.option_changes = option_changes(world);
}

}  // namespace

PreparedRun prepare_run(const worlds::World& world, const seif::Registry& registry) {
  refuse_team(world, "this call");
  return prepare_run(world, registry, sim::make_simulator(world));
}

void refuse_team(const worlds::World& world, const std::string& command) {
  if (world.robots.empty()) return;
  throw BadInput(
      fmt::format("{}: the world has {} robots, and {} is for worlds of one. seifbed run runs it; the folder "
                  "of each robot is then a run of its own",
                  world.name, world.robots.size(), command));
}

PreparedRun prepare_run(const worlds::World& world, const seif::Registry& registry,
                        std::unique_ptr<sim::Simulator> simulator) {
  PreparedRun run;
  run.believers = std::make_unique<Believers>();
  set_stream(run, std::make_unique<SimulatedStream>(
                      world, steering_pose(world.drive.pose_from, *run.believers), std::move(simulator)));
  AbleEstimators able = some_able_estimators(registry, world, *run.log);
  check_steering(world, able);
  set_estimators(run, world, registry, std::move(able));
  run.plan.name = world.name;
  run.plan.end_t = world.duration;
  return run;
}

PreparedRun prepare_replay(const std::filesystem::path& log, const worlds::World& world,
                           const seif::Registry& registry) {
  return prepare_replay(LogChoice{.path = log}, world, registry);
}

PreparedRun prepare_replay(const LogChoice& log, const worlds::World& world, const seif::Registry& registry) {
  refuse_team_folder(log.path);
  PreparedRun run;
  run.believers = std::make_unique<Believers>();
  set_stream(run, open_log(log));
  const Remedy remedy = [](const std::vector<std::string>& types) {
    return fmt::format("--estimators {}", fmt::join(types, ","));
  };
  set_estimators(run, world, registry, some_able_estimators(registry, world.estimators, *run.log, remedy));
  run.stream = with_heard_packets(std::move(run.stream), log.path, *run.believers);
  run.plan.name = run.log->name;
  return run;
}

void leave_out_missing(worlds::World& world, const Believers& believers) {
  std::erase_if(world.estimators, [&](const worlds::EstimatorChoice& choice) {
    return std::ranges::find(believers.estimators, choice.name, &LiveEstimator::name) ==
           believers.estimators.end();
  });
}

RunResult execute(PreparedRun& run, RunListener* follower) {
  return execute(*run.stream, *run.log, *run.believers, run.plan, follower);
}

RunResult execute_in_passing(PreparedRun& run, RunListener* follower) {
  const TemporaryFolder folder;
  run.plan.folder = folder.path();
  run.plan.quiet = true;
  return execute(run, follower);
}

void write_world(const std::filesystem::path& folder, const worlds::World& world, std::string resolved) {
  const std::vector<NamedFile> files = files_of(world);
  if (!files.empty()) {
    std::vector<worlds::Problem> problems;
    std::optional<worlds::Node> document = worlds::parse_document(resolved, "world.yaml", problems);
    for (const NamedFile& file : files) {
      std::filesystem::copy_file(file.from, folder / file.name);
      worlds::apply_override(*document, fmt::format("{}={}", file.key, file.name), problems);
    }
    resolved = worlds::emit(*document);
  }
  write_whole_file(folder / "world.yaml", resolved);
}

void write_replayed_world(const std::filesystem::path& folder, const std::filesystem::path& log,
                          const std::string& resolved) {
  if (!std::filesystem::exists(log / "world.yaml"))
    return write_whole_file(folder / "replay.yaml", settings_of_replay(resolved));
  write_whole_file(folder / "world.yaml", resolved);
  for (const char* file : {commands_file, takeover_file}) {
    if (std::filesystem::exists(log / file)) std::filesystem::copy_file(log / file, folder / file);
  }
}

}  // namespace harness
