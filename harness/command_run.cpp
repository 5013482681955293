#include <fmt/format.h>

#include <memory>

#include "harness/commands.hpp"
#include "harness/estimator_schemas.hpp"
#include "harness/film/film.hpp"
#include "harness/interrupt.hpp"
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
  bool film = false;
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
  if (!arguments.film) return print_result(execute(run), run.plan.folder, arguments.output);
  Film film(film_plan(world), *run.log, *run.believers,
            make_frame_sink(run.plan.folder / "film.mp4",
                            {world.film.width, world.film.height, world.film.fps}, false));
  film.after_each_frame([] { return !InterruptGuard::flag(); });
  const RunResult result = execute(run, &film);
  const int code = print_result(result, run.plan.folder, arguments.output);
  film.finish(result.error.empty() && !result.summary.interrupted);
  return code;
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
      "  seifbed run worlds/courtyard.yaml --film --set film.camera=chase --set film.layers.rays=false\n"
      "  seifbed run worlds/courtyard.yaml --json | jq .estimators.ekf.nees_pose");
  auto arguments = std::make_shared<RunArguments>();
  command->add_option("WORLD", arguments->world, "World file")->required();
  command->add_option("--set", arguments->overrides, "Set a value of the world file: path.to.key=value")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->seed, "Seed of everything that is random")->type_name("INT");
  command->add_option("--duration", arguments->duration, "Simulated time [s]");
  command->add_flag("--film", arguments->film,
                    "Film it as it runs, to film.mp4 in its folder, as the world file's film section says; "
                    "drawing between the updates makes their times a little longer");
  add_output_options(*command, arguments->output, "runs/<world>-<seed>");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return run_world(*arguments, registry); });
  });
}

}  // namespace harness
