#include <fmt/format.h>

#include <memory>

#include "harness/commands.hpp"
#include "harness/estimator_schemas.hpp"
#include "harness/prepared_run.hpp"
#include "harness/run_folder.hpp"
#include "harness/version.hpp"

namespace harness {

namespace {

struct RunArguments {
  std::string world;
  std::vector<std::string> overrides;
  std::string seed;                // checked as part of the world; empty: the file's
  std::optional<double> duration;  // [s]
  OutputArguments output;
};

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
  PreparedRun run = prepare_run(world, registry);
  open_folder(run, arguments.output, fmt::format("{}-{}", file_name_of(world.name), world.seed));
  write_world(run.plan.folder, world, loaded.resolved);
  return print_result(execute(run), run.plan.folder, arguments.output);
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
  add_output_options(*command, arguments->output, "runs/<world>-<seed>");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return run_world(*arguments, registry); });
  });
}

}  // namespace harness
