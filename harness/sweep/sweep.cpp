#include "harness/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>

#include "harness/comparison/baseline.hpp"
#include "harness/comparison/seeds.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/detailed_run.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/run/runnable_world.hpp"
#include "harness/sweep/processes.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/progress.hpp"
#include "harness/terminal/version.hpp"
#include "worlds/merge.hpp"

namespace harness {

namespace {

/// The world as written, with the files that it extends and the overrides of all runs, but without defaults:
/// a varied value may change which defaults apply.
std::string world_as_written(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                             const std::string& name) {
  std::vector<worlds::Problem> none;
  worlds::Node document = worlds::read_extended_document(file, none).value();
  for (const std::string& assignment : overrides) worlds::apply_override(document, assignment, none);
  if (document.find("name") == nullptr) {
    worlds::Node text;
    text.kind = worlds::Node::Kind::scalar;
    text.quoted = true;
    text.text = name;
    document.entries.insert(document.entries.begin(), {"name", document.where, std::move(text)});
  }
  return worlds::emit(document);
}

/// Loads the world of each setting. A problem with a varied value is reported for its --vary.
std::vector<worlds::Problem> check_settings(const std::filesystem::path& world, const SweepPlan& plan,
                                            const seif::Registry& registry) {
  for (std::size_t setting = 0; setting < setting_count(plan); ++setting) {
    const std::vector<std::string> overrides = overrides_of(plan, {setting, plan.seeds.front()});
    worlds::LoadResult loaded = load_runnable_world(world, overrides, registry);
    for (worlds::Problem& problem : loaded.problems) {
      std::string source = *problem.where.source;
      if (source.starts_with("--set ")) source.replace(0, 5, "--vary");
      problem.where.source = std::make_shared<const std::string>(source);
    }
    if (!loaded.world) return loaded.problems;
    const auto& estimators = loaded.world->estimators;
    if (std::ranges::find(estimators, plan.baseline, &worlds::EstimatorChoice::name) == estimators.end())
      throw BadInput(fmt::format("--baseline: with {} there is no estimator '{}' to compare with",
                                 fmt::join(overrides, " "), plan.baseline));
  }
  return {};
}

std::string execute_cell(const SweepFolder& sweep, std::size_t index, const seif::Registry& registry,
                         DetailedRun& done) {
  const worlds::LoadResult loaded =
      load_runnable_world(sweep.world(), overrides_of(sweep.plan, cell_at(sweep.plan, index)), registry);
  if (!loaded.world) return worlds::to_string(loaded.problems.front());
  PreparedRun run = prepare_run(*loaded.world, registry);
  const TemporaryFolder folder;
  run.plan.folder = folder.path();
  run.plan.quiet = true;
  done = execute_in_detail(run);
  return done.result.error;
}

/// Runs a cell in its own process. Returns the exit code.
int run_cell(const SweepFolder& sweep, std::size_t index, const seif::Registry& registry) {
  DetailedRun done;
  std::string failure;
  try {
    failure = execute_cell(sweep, index, registry, done);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  if (done.result.summary.interrupted) return 130;
  if (failure.empty()) {
    sweep.cells().put_result(index, to_json(done));
  } else {
    sweep.cells().put_failure(index, failure);
  }
  return 0;
}

std::vector<std::size_t> cells_to_run(const SweepFolder& sweep, const Shard& shard) {
  const std::vector<CellState> states = sweep.states();
  std::vector<std::size_t> cells;
  for (std::size_t i = shard.number - 1; i < states.size(); i += shard.of) {
    if (states[i] != CellState::done) cells.push_back(i);
  }
  return cells;
}

}  // namespace

Shard parse_shard(std::string_view text) {
  Shard shard;
  const char* begin = text.data();
  const char* end = begin + text.size();
  const auto [slash, error] = std::from_chars(begin, end, shard.number);
  const bool has_slash = error == std::errc() && slash != end && *slash == '/';
  const auto [rest, of_error] = std::from_chars(has_slash ? slash + 1 : end, end, shard.of);
  if (!has_slash || of_error != std::errc() || rest != end || shard.number < 1 || shard.number > shard.of)
    throw BadInput(
        fmt::format("--shard {}: is no shard; what is meant is like 3/16, from 1/16 to 16/16", text));
  return shard;
}

BegunSweep begin_sweep(const SweepChoices& choices, const std::filesystem::path& out,
                       const seif::Registry& registry) {
  SweepPlan plan;
  plan.version = program_version();
  plan.seeds = parse_seeds(choices.seeds);
  for (const std::string& axis : choices.axes) plan.axes.push_back(parse_axis(axis));
  check_plan(plan);
  check_overrides(plan, choices.overrides);
  std::vector<std::string> overrides = choices.overrides;
  const worlds::LoadResult loaded = load_with_baseline(choices.baseline, registry, overrides, [&] {
    return load_runnable_world(choices.world, overrides, registry);
  });
  if (!loaded.world) return {std::nullopt, loaded.problems};
  const worlds::World& world = *loaded.world;
  refuse_team(world, "seifbed sweep");
  plan.name = world.name;
  plan.baseline = choose_baseline(choices.baseline, world.estimators);
  const TemporaryFolder staged;
  write_world(staged.path(), world, world_as_written(choices.world, overrides, world.name));
  BegunSweep begun;
  begun.problems = check_settings(staged / "world.yaml", plan, registry);
  if (!begun.problems.empty()) return begun;
  begun.folder = begin_sweep(out, plan, [&](const std::filesystem::path& to) {
    copy_world({staged.path(), plan}, to);
  });
  return begun;
}

bool run_cells(const SweepFolder& sweep, const Shard& shard, int jobs, bool quiet,
               const seif::Registry& registry) {
  if (shard.of == 1) remove_unfinished(sweep);
  const std::vector<std::size_t> cells = cells_to_run(sweep, shard);
  const FileLock alive = lock_of_sweep(sweep);
  const InterruptGuard guard;
  const std::atomic<bool>& stop = InterruptGuard::flag();
  CountProgress progress(quiet, cells.size(), "runs");
  std::size_t ended = 0;
  run_in_processes(
      cells, jobs, stop, [&](std::size_t cell) { return run_cell(sweep, cell, registry); },
      [&](std::size_t cell, const ProcessEnd& end) {
        if (!end.is_good() && !stop) sweep.cells().put_failure(cell, to_string(end));
        progress.show(++ended);
      });
  return !stop;
}

SweepFolder merge_sweeps(const std::vector<std::string>& folders, const std::filesystem::path& out) {
  const SweepFolder first = open_sweep(folders.front());
  const SweepFolder merged =
      begin_sweep(out, first.plan, [&](const std::filesystem::path& to) { copy_world(first, to); });
  remove_unfinished(merged);
  const CellFolder to = merged.cells();
  for (const std::string& folder : folders) {
    const SweepFolder from = open_sweep(folder);
    check_same_sweep(from, merged);
    const std::vector<CellState> there = from.states();
    const std::vector<CellState> here = merged.states();
    for (std::size_t i = 0; i < there.size(); ++i) {
      if (there[i] == CellState::done && here[i] != CellState::done) to.put_result(i, from.cells().result(i));
      if (there[i] == CellState::failed && here[i] == CellState::open)
        to.put_failure(i, from.cells().failure(i));
    }
  }
  return merged;
}

}  // namespace harness
