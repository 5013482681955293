#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>

#include "harness/commands/commands.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/run/replay_settings.hpp"
#include "harness/terminal/checks.hpp"

namespace harness {

namespace {

struct ReplayArguments {
  LogChoice log;
  ReplayChoices choices;
  OutputArguments output;
};

bool sets_noise(const std::string& assignment) {
  return assignment.starts_with("noise.") || assignment.starts_with("noise=");
}

int replay(const ReplayArguments& arguments, const seif::Registry& registry) {
  const TemporaryFolder spare;
  LogChoice log = arguments.log;
  log.path = whole_log(log.path, spare.path());
  ReplayChoices choices = arguments.choices;
  std::ranges::copy_if(choices.overrides, std::back_inserter(log.noise.overrides), sets_noise);
  std::erase_if(choices.overrides, sets_noise);
  choices.defaults = default_settings(format_of(log));
  const worlds::LoadResult settings = load_replay_settings(log.path, choices, registry);
  if (!settings.world) {
    print_problems(settings.problems);
    return 2;
  }
  PreparedRun run = prepare_replay(log, *settings.world, registry);
  open_folder(run, arguments.output, file_name_of(run.plan.name) + "-replay");
  write_replayed_world(run.plan.folder, log.path, settings.resolved);
  return print_result(execute(run), run.plan.folder, arguments.output);
}

}  // namespace

void add_replay(CommandLine line) {
  CLI::App* command =
      line.app.add_subcommand("replay", "Feed a recorded log, such as a run folder, to estimators");
  command->footer(
      "Examples:\n"
      "  seifbed replay runs/courtyard-1\n"
      "  seifbed replay runs/courtyard-1 --estimators ekf --set estimators.ekf.odometry_sd_factor=2\n"
      "  seifbed replay my_log --estimators ekf,seif --out /tmp/mine\n"
      "  seifbed replay MRCLAM_Dataset6 --robot 3 --set noise.range_sd_m=0.15\n"
      "  seifbed replay victoria_park.txt --estimators seif\n"
      "  seifbed replay victoria_park --set estimators.seif.association=nearest\n"
      "  seifbed replay cityTrees10000.txt --truth cityTrees10000_groundtruth.txt\n"
      "A folder with a world.yaml is replayed with the estimators and options that stand there; any other "
      "with\n"
      "ekf, seif and seif_report, and logs of other formats with ekf and seif. The log format is described "
      "in\n"
      "docs/log_format.md, the others, and the noise that is taken for them, in docs/datasets.md.");
  auto arguments = std::make_shared<ReplayArguments>();
  command->add_option("LOG", arguments->log.path, "A log: a folder, or a file")->required();
  add_log_options(*command, arguments->log);
  command
      ->add_option("--estimators", arguments->choices.estimators,
                   "Only these: names from world.yaml, or types")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option(
          "--set", arguments->choices.overrides,
          "Set a value of estimators, scoring, film, seed or noise: path.to.key=value; a log's own noise is "
          "replaced as a whole")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->choices.seed, "Seed of the estimators that draw")
      ->check(seed_number())
      ->type_name("INT");
  add_output_options(*command, arguments->output, "runs/<log>-replay");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return replay(*arguments, registry); });
  });
}

}  // namespace harness
