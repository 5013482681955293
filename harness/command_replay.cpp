#include <fmt/format.h>

#include <memory>

#include "harness/commands.hpp"
#include "harness/prepared_run.hpp"
#include "harness/replay_settings.hpp"
#include "harness/run_folder.hpp"
#include "harness/unfinished.hpp"

namespace harness {

namespace {

struct ReplayArguments {
  std::string folder;
  ReplayChoices choices;
  OutputArguments output;
};

int replay(const ReplayArguments& arguments, const seif::Registry& registry) {
  const TemporaryFolder spare;
  const std::filesystem::path log = whole_log(arguments.folder, spare.path());
  const worlds::LoadResult settings = load_replay_settings(log, arguments.choices, registry);
  if (!settings.world) {
    print_problems(settings.problems);
    return 2;
  }
  PreparedRun run = prepare_replay(log, *settings.world, registry);
  open_folder(run, arguments.output, file_name_of(run.plan.name) + "-replay");
  write_replayed_world(run.plan.folder, log, settings.resolved);
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
      "A folder with a world.yaml is replayed with the estimators and options that stand there;\n"
      "any other with ekf, seif and seif_report. The log format is described in docs/log_format.md.");
  auto arguments = std::make_shared<ReplayArguments>();
  command->add_option("FOLDER", arguments->folder, "Log folder")->required();
  command
      ->add_option("--estimators", arguments->choices.estimators,
                   "Only these: names from world.yaml, or types")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--set", arguments->choices.overrides,
                   "Set a value of estimators, scoring, film or seed: path.to.key=value")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->choices.seed, "Seed of the estimators that draw")
      ->type_name("INT");
  add_output_options(*command, arguments->output, "runs/<log>-replay");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return replay(*arguments, registry); });
  });
}

}  // namespace harness
