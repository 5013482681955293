#include "harness/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/sweep/slurm.hpp"
#include "harness/sweep/status.hpp"
#include "harness/terminal/checks.hpp"
#include "harness/terminal/messages.hpp"

namespace harness {

namespace {

struct SweepArguments {
  SweepChoices choices;
  std::string world;
  std::string out;
  std::string resume;  // folder of a sweep to continue; empty: begin with WORLD
  std::string status;  // folder of a sweep whose progress is printed
  std::string shard = "1/1";
  bool slurm = false;
  SlurmChoices slurm_choices;
  int jobs = 1;
  bool json = false;
  bool quiet = false;
};

struct MergeArguments {
  std::vector<std::string> folders;
  std::string out;
  bool json = false;
  bool quiet = false;
};

bool has_failure(const Aggregate& aggregate) {
  const auto failed = [](const EstimatorStatistics& estimator) { return estimator.failed > 0; };
  return !aggregate.failed.empty() ||
         std::ranges::any_of(aggregate.settings, [&](const SettingStatistics& setting) {
           return std::ranges::any_of(setting.estimators, failed);
         });
}

/// Writes the tables and prints the results. Returns the exit code.
int finish(const SweepFolder& sweep, bool json, bool quiet) {
  const Aggregate aggregate = write_tables(sweep);
  return print_output({.out = {}, .json = json, .quiet = quiet}, to_json(aggregate),
                      aggregate_board(aggregate), sweep.path, has_failure(aggregate) ? 1 : 0);
}

/// Prints the progress of a sweep with open runs. The exit code says whether any run of the shard `ours`
/// failed.
int pause(const SweepFolder& sweep, const SweepStatus& status, const Shard& ours, bool quiet) {
  const bool failed = std::ranges::any_of(
      status.failed, [&](const FailedCell& cell) { return cell.index % ours.of == ours.number - 1; });
  return print_all(quiet ? "" : to_text(sweep, status), failed ? 1 : 0);
}

/// The sweep folder that the command line refers to. Empty if the world has problems.
std::optional<SweepFolder> find_sweep(const SweepArguments& arguments, const seif::Registry& registry) {
  if (!arguments.resume.empty()) return open_sweep(arguments.resume);
  if (arguments.world.empty()) throw BadInput("sweep: WORLD is required, or --resume DIR, or --status DIR");
  if (arguments.choices.seeds.empty()) throw BadInput("--seeds is required, such as --seeds 1..100");
  if (arguments.out.empty()) throw BadInput("--out is required: the folder of the sweep");
  BegunSweep begun = begin_sweep(arguments.choices, arguments.out, registry);
  print_problems(begun.problems);
  return begun.folder;
}

int tell_status(const SweepFolder& sweep) {
  const SweepStatus status = status_of(sweep);
  std::string text = to_text(sweep, status);
  if (is_slurm_sweep(sweep) && status.open + status.failed.size() > 0)
    text += to_text(slurm_queue(sweep)) + '\n';
  if (is_going_on(sweep)) {
    text += "still going on\n";
  } else if (status.open > 0 && !is_slurm_sweep(sweep)) {
    text += fmt::format("not going on: seifbed sweep --resume {} continues it\n", sweep.path.string());
  }
  return print_all(text, status.failed.empty() ? 0 : 1);
}

/// Runs the cells of this process. Returns the exit code.
int run_here(const SweepFolder& sweep, const Shard& shard, const SweepArguments& arguments,
             const seif::Registry& registry) {
  const bool quiet = arguments.quiet || arguments.json;
  if (!run_cells(sweep, shard, arguments.jobs, quiet, registry)) return 130;
  const SweepStatus status = status_of(sweep);
  if (status.open > 0) return pause(sweep, status, shard, quiet);
  return finish(sweep, arguments.json, arguments.quiet);
}

int run_on_slurm(const SweepFolder& sweep, const SweepArguments& arguments) {
  SlurmChoices choices = arguments.slurm_choices;
  choices.jobs = arguments.jobs;
  const SweepStatus status = status_of(sweep);
  if (status.open + status.failed.size() == 0) return finish(sweep, arguments.json, arguments.quiet);
  const std::string text = submit(sweep, choices);
  return print_all(arguments.quiet ? "" : to_text(sweep, status) + text, 0);
}

int run_sweep(const SweepArguments& arguments, const seif::Registry& registry) {
  if (!arguments.status.empty()) return tell_status(open_sweep(arguments.status));
  const Shard shard = parse_shard(arguments.shard);
  const std::optional<SweepFolder> sweep = find_sweep(arguments, registry);
  if (!sweep) return 2;
  return arguments.slurm ? run_on_slurm(*sweep, arguments) : run_here(*sweep, shard, arguments, registry);
}

int merge(const MergeArguments& arguments) {
  const SweepFolder sweep = merge_sweeps(arguments.folders, arguments.out);
  const SweepStatus status = status_of(sweep);
  if (status.open == 0) return finish(sweep, arguments.json, arguments.quiet);
  tell_warning(
      fmt::format("{}to go on: seifbed sweep --resume {}", to_text(sweep, status), sweep.path.string()));
  return 1;
}

void add_what_is_swept(CLI::App& command, SweepArguments& arguments) {
  command.add_option("WORLD", arguments.world, "World file");
  command.add_option("--seeds,--seed", arguments.choices.seeds,
                     "Seeds, such as 1..100 or 1,2,7, or a single one");
  command
      .add_option("--vary", arguments.choices.axes,
                  "Values of the world file to go through: path.to.key=v1,v2,..; several make a product")
      ->allow_extra_args(false);
  command.add_option("--set", arguments.choices.overrides, "Set a value for all runs: path.to.key=value")
      ->allow_extra_args(false);
  command.add_option(
      "--baseline", arguments.choices.baseline,
      "Estimator that differences are taken to; added if it is a type; by default ekf, or the first");
  command.add_option("--out", arguments.out,
                     "Folder of the sweep; the same call goes on with one that is there");
}

void add_how_it_is_swept(CLI::App& command, SweepArguments& arguments) {
  command.add_option("--jobs", arguments.jobs, "Runs at the same time")
      ->check(whole_number(1, most_jobs))
      ->type_name("INT");
  command.add_option("--shard", arguments.shard, "Only a part of the runs, such as 3/16");
  command.add_option("--resume", arguments.resume, "Go on with the sweep in this folder")
      ->excludes("WORLD")
      ->excludes("--out")
      ->excludes("--seeds")
      ->excludes("--vary")
      ->excludes("--set")
      ->excludes("--baseline");
  command.add_option("--status", arguments.status, "Say how far the sweep in this folder is")
      ->excludes("WORLD")
      ->excludes("--resume");
  command.add_flag("--json", arguments.json, "Print aggregate.json instead of the table");
  command.add_flag("--quiet", arguments.quiet, "Print errors only");
}

void add_slurm(CLI::App& command, SweepArguments& arguments) {
  command
      .add_flag("--slurm", arguments.slurm,
                "Submit what is not done, and not in the queue, as a job array, and a job that merges it")
      ->excludes("--shard");
  command.add_option("--array", arguments.slurm_choices.tasks, "Tasks of the job array; 64 by default")
      ->check(whole_number(1, 1'000'000))
      ->type_name("INT")
      ->needs("--slurm");
  command
      .add_option("--sbatch", arguments.slurm_choices.options,
                  "Option for sbatch, such as --sbatch=--partition=long; may stand several times")
      ->allow_extra_args(false)
      ->needs("--slurm");
}

}  // namespace

void add_sweep(CommandLine line) {
  CLI::App* command = line.app.add_subcommand(
      "sweep", "Run a world with all seeds and settings, in processes of their own; goes on after a kill");
  command->footer(
      "Examples:\n"
      "  seifbed sweep worlds/report2002.yaml --seeds 1..100 --vary estimators.seif.theta_x=4,6,8,16 \\\n"
      "    --set physics.engine=kinematic --jobs 2 --out theta\n"
      "  seifbed sweep --status theta\n"
      "  seifbed sweep --resume theta --jobs 2\n"
      "  seifbed sweep worlds/loop.yaml --seeds 1..64 --shard 3/16 --out part3; seifbed merge part* --out "
      "all\n"
      "Runs that are done are never done again; runs that failed are tried again by the next call.\n"
      "The files of the folder, and what the columns mean, are described in docs/sweeps.md.");
  auto arguments = std::make_shared<SweepArguments>();
  add_what_is_swept(*command, *arguments);
  add_how_it_is_swept(*command, *arguments);
  add_slurm(*command, *arguments);
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    arguments->choices.world = arguments->world;
    code = guarded([&] { return run_sweep(*arguments, registry); });
  });
}

void add_merge(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("merge", "Put the shards of a sweep together");
  command->footer(
      "Example:\n"
      "  seifbed merge part1 part2 part3 --out all\n"
      "The order of the shards makes no difference: the tables have the bytes of a sweep in one piece.");
  auto arguments = std::make_shared<MergeArguments>();
  command->add_option("DIR", arguments->folders, "Folders of sweeps with the same world, seeds and values")
      ->required();
  command->add_option("--out", arguments->out, "Folder to write to; one of them, or a new one")->required();
  command->add_flag("--json", arguments->json, "Print aggregate.json instead of the table");
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->callback([=, &code = line.exit_code] { code = guarded([&] { return merge(*arguments); }); });
}

}  // namespace harness
