#include "harness/paper/paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/comparison/baseline.hpp"
#include "harness/comparison/seeds.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/paper/drawn_run.hpp"
#include "harness/paper/paper_report.hpp"
#include "harness/terminal/checks.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/messages.hpp"

namespace harness {

namespace {

constexpr std::int64_t most_runs = 1'000'000;

struct PaperArguments {
  PaperPlan plan;
  std::string seeds;  // instead of --seed and --runs; empty: these
  OutputArguments output;
};

/// The runs of --seeds, which follow one another.
void take_seeds(PaperArguments& arguments) {
  if (arguments.seeds.empty()) return;
  const std::vector<std::uint64_t> seeds = parse_seeds(arguments.seeds);
  if (seeds.back() - seeds.front() != seeds.size() - 1)
    throw BadInput(fmt::format("--seeds {}: the seeds of seifbed paper follow one another, as in 1..100",
                               arguments.seeds));
  arguments.plan.first_seed = seeds.front();
  arguments.plan.runs = static_cast<std::int64_t>(seeds.size());
}

int reproduce(PaperArguments arguments, const seif::Registry& registry) {
  const InterruptGuard guard;
  PaperPlan& plan = arguments.plan;
  take_seeds(arguments);
  plan.quiet = arguments.output.quiet || arguments.output.json;
  const worlds::LoadResult loaded = load_paper_world(plan, registry);
  if (!loaded.world) {
    print_problems(loaded.problems);
    return 2;
  }
  const worlds::World& world = *loaded.world;
  static_cast<void>(choose_baseline("ekf", world.estimators));
  plan.folder = make_folder(arguments.output, "paper");
  write_world(plan.folder, world, loaded.resolved);

  const Comparison comparison = run_paper(plan, world.name, registry);
  const std::string json = paper_json(plan, world, comparison);
  const std::string board = paper_board(plan, world, comparison);
  write_whole_file(plan.folder / "paper.json", json);
  write_whole_file(plan.folder / "runs.csv", paper_runs_csv(comparison));
  write_whole_file(plan.folder / "times.json", paper_times_json(plan, comparison));
  write_whole_file(plan.folder / "paper.txt", board);
  if (!comparison.interrupted) {
    const std::string complaint = draw_figures(plan, registry);
    if (!complaint.empty()) tell_warning(complaint);
  }
  const int code = InterruptGuard::flag() ? 130 : exit_code(comparison);
  return print_output(arguments.output, json, board, plan.folder, code);
}

void add_options(CLI::App& command, PaperArguments& arguments) {
  PaperPlan& plan = arguments.plan;
  plan.jobs = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 256);
  command.add_option("--runs", plan.runs, "Runs, each with a seed of its own")
      ->check(whole_number(1, most_runs))
      ->capture_default_str();
  command.add_option("--seed", plan.first_seed, "Seed of the first run; those of the others follow")
      ->check(whole_number(0, largest_seed - most_runs))
      ->type_name("INT")
      ->capture_default_str();
  command
      .add_option("--seeds", arguments.seeds,
                  "Seeds of the runs, such as 1..100, instead of --seed and --runs")
      ->excludes("--runs")
      ->excludes("--seed");
  command.add_option("--jobs", plan.jobs, "Runs at the same time; by default one for each processor")
      ->check(whole_number(1, most_jobs))
      ->type_name("INT");
  command.add_flag("--physics", plan.physics, "In Bullet, with contacts and slip, instead of by kinematics");
  command.add_option("--set", plan.overrides, "Set a value of the world file: path.to.key=value")
      ->allow_extra_args(false);
  add_output_options(command, arguments.output, "runs/paper", "paper.json instead of the tables");
}

}  // namespace

void add_paper(CommandLine line) {
  CLI::App* command = line.app.add_subcommand(
      "paper", "Reproduce section 4 of the 2002 report: its table and figures, with our filters beside");
  command->footer(
      "Examples:\n"
      "  seifbed paper\n"
      "  seifbed paper --runs 100 --out paper\n"
      "  seifbed paper --physics --runs 200 --jobs 2\n"
      "  seifbed paper --runs 100 --set estimators.seif_report.theta_x=10 --json | jq .estimators\n"
      "50 landmarks, 500 updates, six active landmarks, 1,000 runs. The folder gets paper.txt, paper.json,\n"
      "runs.csv, times.json, world.yaml, and figures 1, 2 and 6 as PNG and SVG. docs/paper.md tells what\n"
      "differs from the report.");
  auto arguments = std::make_shared<PaperArguments>();
  add_options(*command, *arguments);
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return reproduce(*arguments, registry); });
  });
}

}  // namespace harness
