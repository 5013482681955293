#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "harness/commands.hpp"
#include "harness/csv_reader.hpp"
#include "harness/csv_writer.hpp"
#include "harness/estimator_schemas.hpp"
#include "harness/run_folder.hpp"
#include "harness/simulated_stream.hpp"
#include "harness/version.hpp"
#include "worlds/merge.hpp"

namespace harness {

namespace {

struct RunArguments {
  std::string world;
  std::vector<std::string> overrides;
  std::string seed;                // checked as part of the world; empty: the file's
  std::optional<double> duration;  // [s]
  std::string out;
  bool json = false;
  bool quiet = false;
};

/// The commands' own file name in the run folder, where world.yaml finds it again.
constexpr const char* commands_file = "commands.csv";

/// Writes world.yaml, and beside it what it needs, so that it runs again from there.
void write_world(const std::filesystem::path& folder, const worlds::World& world, std::string resolved) {
  if (world.drive.mode == worlds::DriveMode::commands) {
    std::filesystem::copy_file(world.drive.commands_file, folder / commands_file);
    std::vector<worlds::Problem> problems;
    std::optional<worlds::Node> document = worlds::parse_document(resolved, "world.yaml", problems);
    worlds::apply_override(*document, fmt::format("drive.file={}", commands_file), problems);
    resolved = worlds::emit(*document);
  }
  write_whole_file(folder / "world.yaml", resolved);
}

int run_world(const RunArguments& arguments, const seif::Registry& registry) {
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.seed.empty()) overrides.push_back("seed=" + arguments.seed);
  if (arguments.duration) overrides.push_back(fmt::format("duration_s={}", *arguments.duration));
  const worlds::LoadResult loaded =
      worlds::load_world(arguments.world, overrides, estimator_schemas(registry), program_version());
  if (!loaded.world) {
    print_problems(loaded.problems);
    return 2;
  }
  const worlds::World& world = *loaded.world;

  Believers believers;
  SimulatedStream stream(world, steering_pose(world.drive.pose_from, believers));
  believers.estimators = make_estimators(registry, world.estimators, stream.description(), world.seed);
  RunPlan plan;
  plan.folder = arguments.out.empty()
                    ? create_run_folder("runs", fmt::format("{}-{}", file_name_of(world.name), world.seed))
                    : create_empty_folder(arguments.out);
  plan.name = world.name;
  plan.seed = world.seed;
  plan.scoring = world.scoring;
  plan.end_t = world.duration;
  plan.quiet = arguments.quiet || arguments.json;
  write_world(plan.folder, world, loaded.resolved);
  return print_result(execute(stream, stream.description(), believers, plan), plan.folder, arguments.json,
                      arguments.quiet);
}

}  // namespace

void add_run(CommandLine line) {
  CLI::App* command =
      line.app.add_subcommand("run", "Run a world: drive, sense, estimate live, record and score");
  command->footer(
      "Examples:\n"
      "  seifbed run worlds/courtyard.yaml\n"
      "  seifbed run worlds/courtyard.yaml --seed 7 --duration 60 --out /tmp/seven\n"
      "  seifbed run worlds/courtyard.yaml --set drive.pose_from=odometry --set estimators.ekf={}\n"
      "  seifbed run worlds/courtyard.yaml --json | jq .estimators.ekf.nees_pose");
  auto arguments = std::make_shared<RunArguments>();
  command->add_option("WORLD", arguments->world, "World file")->required();
  command->add_option("--set", arguments->overrides, "Set a value of the world file: path.to.key=value")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->seed, "Seed of everything that is random")->type_name("INT");
  command->add_option("--duration", arguments->duration, "Simulated time [s]");
  command->add_option("--out", arguments->out,
                      "Folder to write to; by default a new one, runs/<world>-<seed>");
  command->add_flag("--json", arguments->json, "Print summary.json instead of the scoreboard");
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return run_world(*arguments, registry); });
  });
}

}  // namespace harness
