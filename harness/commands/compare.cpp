#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/comparison/baseline.hpp"
#include "harness/comparison/parallel_runs.hpp"
#include "harness/comparison/seeds.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/overrides.hpp"
#include "harness/run/replay_settings.hpp"
#include "harness/run/runnable_world.hpp"
#include "harness/terminal/checks.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

struct CompareArguments {
  std::vector<std::string> inputs;  // one world file, or log folders
  std::string seeds;                // empty: 1..20, for a world
  ReplayChoices choices;            // its overrides are used for worlds too
  std::string baseline;             // empty: the ekf, otherwise the first
  int jobs = 1;
  std::optional<double> duration;  // [s] of a world
  std::string keep;                // empty: the run folders are deleted
  std::string out;                 // folder for the tables and comparison.json; empty: none
  bool json = false;
  bool quiet = false;
};

/// Runs in a folder inside `keep`, or in a temporary folder.
template <class WriteWorld>
DetailedRun execute_in(const std::string& keep, const std::string& name, PreparedRun run,
                       const WriteWorld& write_world_to) {
  const std::optional<TemporaryFolder> temporary =
      keep.empty() ? std::make_optional<TemporaryFolder>() : std::nullopt;
  run.plan.folder = create_run_folder(temporary ? temporary->path() : std::filesystem::path(keep), name);
  run.plan.quiet = true;
  write_world_to(run.plan.folder);
  return execute_in_detail(run);
}

DetailedRun run_seed(const CompareArguments& arguments, std::uint64_t seed, const seif::Registry& registry) {
  std::vector<std::string> overrides = arguments.choices.overrides;
  overrides.push_back(fmt::format("seed={}", seed));
  const worlds::LoadResult loaded =
      load_runnable_world(arguments.inputs.front(), overrides, registry, program_version());
  if (!loaded.world) throw BadInput(worlds::to_string(loaded.problems.front()));
  const worlds::World& world = *loaded.world;
  return execute_in(
      arguments.keep, fmt::format("{}-{}", file_name_of(world.name), seed), prepare_run(world, registry),
      [&](const std::filesystem::path& folder) { write_world(folder, world, loaded.resolved); });
}

/// Plans the runs of a world, one for each seed. Empty if the world has problems.
std::optional<std::vector<PlannedRun>> plan_seeds(CompareArguments& arguments, const seif::Registry& registry,
                                                  Comparison& comparison) {
  if (!arguments.choices.estimators.empty())
    throw BadInput("--estimators is for logs; for a world: --set 'estimators={ekf: {}, seif: {}}'");
  if (!arguments.choices.seed.empty()) arguments.seeds = arguments.choices.seed;
  std::vector<std::string>& overrides = arguments.choices.overrides;
  for (const std::string& assignment : overrides) {
    if (assignment.starts_with("seed="))
      throw BadInput(fmt::format("--set {}: seeds are given by --seeds", assignment));
  }
  if (arguments.duration)
    add_override(overrides, "--duration", "duration_s", fmt::format("{}", *arguments.duration));
  const std::vector<std::uint64_t> seeds =
      parse_seeds(arguments.seeds.empty() ? "1..20" : std::string_view(arguments.seeds));
  const worlds::LoadResult loaded = load_with_baseline(
      arguments.baseline, registry, arguments.choices.overrides,
      [&] { return load_runnable_world(arguments.inputs.front(), arguments.choices.overrides, registry); });
  if (!loaded.world) {
    print_problems(loaded.problems);
    return std::nullopt;
  }
  refuse_team(*loaded.world, "seifbed compare");
  comparison.name = loaded.world->name;
  comparison.baseline = choose_baseline(arguments.baseline, loaded.world->estimators);
  std::vector<PlannedRun> planned;
  for (const std::uint64_t seed : seeds) {
    planned.push_back({fmt::format("{}-{}", comparison.name, seed),
                       [&arguments, &registry, seed] { return run_seed(arguments, seed, registry); }});
  }
  return planned;
}

/// Plans the runs of logs, one for each. Each log is opened once to check that it can be. Empty if the
/// settings have problems.
std::optional<std::vector<PlannedRun>> plan_logs(CompareArguments& arguments, const seif::Registry& registry,
                                                 Comparison& comparison) {
  if (!arguments.seeds.empty())
    throw BadInput("--seeds is for worlds; a log is recorded. --seed is of the estimators that draw");
  if (arguments.duration) throw BadInput("--duration is for worlds; a log is recorded");
  std::vector<std::string>& names = arguments.choices.estimators;
  if (!names.empty() && !arguments.baseline.empty() &&
      std::ranges::find(names, arguments.baseline) == names.end())
    names.push_back(arguments.baseline);
  std::vector<PlannedRun> planned;
  for (const std::filesystem::path log : arguments.inputs) {
    ReplayChoices choices = arguments.choices;
    const worlds::LoadResult settings =
        load_with_baseline(arguments.baseline, registry, choices.overrides,
                           [&] { return load_replay_settings(log, choices, registry); });
    if (!settings.world) {
      print_problems(settings.problems);
      return std::nullopt;
    }
    const std::string baseline = choose_baseline(arguments.baseline, settings.world->estimators);
    if (planned.empty()) comparison.baseline = baseline;
    if (baseline != comparison.baseline)
      throw BadInput(
          fmt::format("{}: has no estimator '{}' to compare with", log.string(), comparison.baseline));
    const std::string name = file_name_of(prepare_replay(log, *settings.world, registry).plan.name);
    const auto run = [&keep = arguments.keep, &registry, log, name, settings] {
      return execute_in(
          keep, name, prepare_replay(log, *settings.world, registry),
          [&](const std::filesystem::path& folder) { write_replayed_world(folder, log, settings.resolved); });
    };
    planned.push_back({log.string(), run});
  }
  comparison.name = fmt::format("{} logs", planned.size());
  return planned;
}

/// Writes what is printed, as tables and as JSON.
void write_comparison(const Comparison& comparison, const std::filesystem::path& folder) {
  write_whole_file(folder / "comparison.txt", comparison_board(comparison));
  write_whole_file(folder / "comparison.json", to_json(comparison));  // last: the folder is complete
}

int compare(CompareArguments arguments, const seif::Registry& registry) {
  Comparison comparison;
  const bool are_logs = std::filesystem::is_directory(arguments.inputs.front());
  if (!are_logs && arguments.inputs.size() > 1)
    throw BadInput("what is compared is one world file, or log folders");
  const std::optional<std::vector<PlannedRun>> planned =
      are_logs ? plan_logs(arguments, registry, comparison) : plan_seeds(arguments, registry, comparison);
  if (!planned) return 2;
  if (!arguments.out.empty()) create_empty_folder(arguments.out);
  if (!arguments.keep.empty()) create_empty_folder(arguments.keep);
  FinishedRuns finished = execute_all(*planned, arguments.jobs, arguments.quiet || arguments.json);
  comparison.runs = std::move(finished.runs);
  comparison.interrupted = finished.interrupted;
  compare_estimators(comparison);
  if (!arguments.out.empty()) write_comparison(comparison, arguments.out);
  std::string text;
  if (arguments.json) {
    text = to_json(comparison);
  } else if (!arguments.quiet) {
    text = comparison_board(comparison);
    if (!arguments.out.empty()) text += fmt::format("\nWritten to {}\n", arguments.out);
  }
  return print_all(text, exit_code(comparison));
}

}  // namespace

void add_compare(CommandLine line) {
  CLI::App* command = line.app.add_subcommand(
      "compare", "Run a world with many seeds, or many logs, and compare the estimators with intervals");
  command->footer(
      "Examples:\n"
      "  seifbed compare worlds/courtyard.yaml\n"
      "  seifbed compare worlds/report2002.yaml --seeds 1..50 --jobs 2 --baseline batch\n"
      "  seifbed compare worlds/courtyard.yaml --seeds 3,5,8 --set 'estimators={ekf: {}, eseif: {}}'\n"
      "  seifbed compare worlds/loop.yaml --duration 60 --out loop\n"
      "  seifbed compare logs/* --estimators ekf,seif --baseline batch --json\n"
      "Every estimator gets the same stream in each run, so ratios are of pairs. Update times are right "
      "with\n"
      "one job alone. What the columns mean is described in docs/scores.md.");
  auto arguments = std::make_shared<CompareArguments>();
  command->add_option("WORLD", arguments->inputs, "World file, or log folders")->required();
  command->add_option("--seeds", arguments->seeds, "Seeds of a world, such as 1..20 (the default) or 1,2,7");
  command
      ->add_option("--seed", arguments->choices.seed,
                   "A single seed of a world; of logs, the seed of the estimators that draw")
      ->check(seed_number())
      ->type_name("INT")
      ->excludes("--seeds");
  command->add_option("--duration", arguments->duration, "Simulated time of a world [s]")
      ->check(positive_number(longest_duration));
  command
      ->add_option("--estimators", arguments->choices.estimators,
                   "On logs, only these: names from world.yaml, or types")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--set", arguments->choices.overrides,
                   "Set a value of the world file; of logs, of estimators and scoring: path.to.key=value")
      ->allow_extra_args(false);
  command->add_option(
      "--baseline", arguments->baseline,
      "Estimator that ratios are taken to; added if it is a type; by default ekf, or the first");
  command->add_option("--jobs", arguments->jobs, "Runs at the same time")
      ->check(whole_number(1, most_jobs))
      ->type_name("INT");
  command->add_option("--out", arguments->out,
                      "Folder to write to: comparison.txt, the tables, and comparison.json, everything");
  command->add_option("--keep", arguments->keep, "Keep the run folders in this folder");
  command->add_flag("--json", arguments->json, "Print everything as JSON, with every run's summary");
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return compare(*arguments, registry); });
  });
}

}  // namespace harness
