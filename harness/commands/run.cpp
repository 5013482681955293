#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/film/film.hpp"
#include "harness/live/live.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/overrides.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/run/resume.hpp"
#include "harness/run/runnable_world.hpp"
#include "harness/team/team.hpp"
#include "harness/team/team_resume.hpp"
#include "harness/team/team_run.hpp"
#include "harness/team/team_summary.hpp"
#include "harness/terminal/checks.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/messages.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

struct RunArguments {
  std::string world;
  std::vector<std::string> overrides;
  std::string seed;                // checked as part of the world; empty: the file's seed
  std::optional<double> duration;  // [s]
  bool film = false;
  bool live = false;
  LiveOptions page;
  bool resume = false;  // then `world` is the folder of a run
  OutputArguments output;
};

int print_result(const TeamResult& result, const std::filesystem::path& folder,
                 const OutputArguments& output) {
  for (const TeamResult::Robot& robot : result.robots) {
    if (!robot.run.error.empty()) tell_error(fmt::format("{}: {}", robot.name, robot.run.error));
  }
  return print_output(output, to_json(result), scoreboard(result), folder, exit_code(result));
}

int run_team(const RunArguments& arguments, const worlds::World& world, const std::string& resolved,
             const seif::Registry& registry) {
  if (arguments.film || arguments.live) refuse_team(world, arguments.film ? "--film" : "--live");
  Team team = prepare_team(world, registry);
  const std::filesystem::path folder =
      make_folder(arguments.output, fmt::format("{}-{}", file_name_of(world.name), world.seed));
  open_team_folder(team, folder, world, resolved);
  return print_result(execute(team, folder, arguments.output.quiet || arguments.output.json), folder,
                      arguments.output);
}

int run_world(const RunArguments& arguments, const seif::Registry& registry) {
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.seed.empty()) add_override(overrides, "--seed", "seed", arguments.seed);
  if (arguments.duration)
    add_override(overrides, "--duration", "duration_s", fmt::format("{}", *arguments.duration));
  const worlds::LoadResult loaded =
      load_runnable_world(arguments.world, overrides, registry, program_version());
  if (!loaded.world) {
    print_problems(loaded.problems);
    return 2;
  }
  const worlds::World& world = *loaded.world;
  if (!world.robots.empty()) return run_team(arguments, world, loaded.resolved, registry);
  PreparedRun run = prepare_run(world, registry);
  open_folder(run, arguments.output, fmt::format("{}-{}", file_name_of(world.name), world.seed));
  write_world(run.plan.folder, world, loaded.resolved);
  if (arguments.live) {
    LiveOnlookers onlookers(world, run, registry, arguments.page);
    return print_result(execute(run, &onlookers.listener()), run.plan.folder, arguments.output);
  }
  if (!arguments.film) return print_result(execute(run), run.plan.folder, arguments.output);
  worlds::World filmed = world;
  leave_out_missing(filmed, *run.believers);
  Film film(film_plan(filmed), *run.log, *run.believers,
            make_frame_sink(run.plan.folder / "film.mp4",
                            {world.film.width, world.film.height, world.film.fps}, false));
  film.after_each_frame([] { return !InterruptGuard::flag(); });
  const RunResult result = execute(run, &film);
  const int code = print_result(result, run.plan.folder, arguments.output);
  film.finish(result.error.empty() && !result.summary.interrupted);
  return code;
}

int resume_run(const RunArguments& arguments, const seif::Registry& registry) {
  const std::filesystem::path folder = arguments.world;
  const bool quiet = arguments.output.quiet || arguments.output.json;
  if (is_team(folder)) {
    if (const std::optional<TeamResult> result = resume_team(folder, registry, quiet))
      return print_result(*result, folder, arguments.output);
  } else if (is_incomplete(folder)) {
    return print_result(resume(folder, registry, quiet), folder, arguments.output);
  }
  return arguments.output.quiet ? 0 : print_all(fmt::format("{} is complete\n", folder.string()), 0);
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
      "  seifbed run worlds/forest.yaml --live\n"
      "  seifbed run worlds/team.yaml\n"
      "  seifbed run --resume runs/courtyard-1\n"
      "  seifbed run worlds/courtyard.yaml --json | jq .estimators.ekf.nees_pose");
  auto arguments = std::make_shared<RunArguments>();
  command->add_option("WORLD", arguments->world, "World file")->required();
  command->add_option("--set", arguments->overrides, "Set a value of the world file: path.to.key=value")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->seed, "Seed of everything that is random")
      ->check(seed_number())
      ->type_name("INT");
  command->add_option("--duration", arguments->duration, "Simulated time [s]")
      ->check(positive_number(longest_duration));
  command->add_flag("--film", arguments->film,
                    "Film it as it runs, to film.mp4 in its folder, as the world file's film section says; "
                    "drawing between the updates makes their times a little longer");
  CLI::Option* look =
      command->add_flag("--live", arguments->live,
                        "Let browsers look at it as it runs; it prints the address. See seifbed live");
  look->excludes(command->get_option("--film"));
  add_page_options(*command, arguments->page);
  CLI::Option* resume = command->add_flag(
      "--resume", arguments->resume,
      "WORLD is the folder of a run that was interrupted, killed or cut off by a full disk: complete it, "
      "with the bytes that it would have had but for times; it is simulated again, which takes as long");
  add_output_options(*command, arguments->output, "runs/<world>-<seed>");
  for (const char* other : {"--set", "--seed", "--duration", "--film", "--live", "--out"})
    resume->excludes(command->get_option(other));
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] {
      return arguments->resume ? resume_run(*arguments, registry) : run_world(*arguments, registry);
    });
  });
}

}  // namespace harness
