// Runs, comparisons and films of whole worlds, as the commands of the program make them.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/comparison/baseline.hpp"
#include "harness/comparison/comparison.hpp"
#include "harness/comparison/parallel_runs.hpp"
#include "harness/estimators/plugins.hpp"
#include "harness/film/film_folder.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/run/runnable_world.hpp"
#include "harness/terminal/version.hpp"
#include "python/bindings.hpp"
#include "python/long_call.hpp"
#include "python/problems.hpp"
#include "worlds/gallery.hpp"

namespace seifbed {

namespace {

using Overrides = std::vector<std::string>;

struct Loaded {
  worlds::World world;
  std::string resolved;
};

Loaded load(const std::filesystem::path& name, const Overrides& overrides, const seif::Registry& registry) {
  worlds::LoadResult loaded =
      harness::load_runnable_world(name, overrides, registry, harness::program_version());
  const std::string resolved = loaded.resolved;
  return {sound_world(std::move(loaded)), resolved};
}

/// With a note for each estimator whose times are those of Python.
harness::PreparedRun prepared(const Loaded& loaded, const seif::Registry& registry) {
  harness::PreparedRun run = harness::prepare_run(loaded.world, registry);
  for (const worlds::EstimatorChoice& choice : loaded.world.estimators) {
    if (is_in_python(harness::type_of(registry, choice)))
      run.plan.notes.push_back(fmt::format("{} is a class of Python: its times include Python", choice.name));
  }
  return run;
}

/// Runs a world into a folder that is empty or missing. Returns (summary.json, why it ended early).
std::pair<std::string, std::string> run(const std::filesystem::path& name, const Overrides& overrides,
                                        const std::filesystem::path& folder, bool quiet,
                                        const seif::Registry& registry) {
  const Loaded loaded = load(name, overrides, registry);
  harness::PreparedRun run = prepared(loaded, registry);
  run.plan.folder = harness::create_empty_folder(folder);
  run.plan.quiet = quiet;
  harness::write_world(run.plan.folder, loaded.world, loaded.resolved);
  const harness::RunResult result = harness::execute(run);
  return {harness::to_json(result.summary), result.error};
}

harness::DetailedRun run_seed(const std::filesystem::path& name, Overrides overrides, std::uint64_t seed,
                              const seif::Registry& registry) {
  overrides.push_back(fmt::format("seed={}", seed));
  const Loaded loaded = load(name, overrides, registry);
  const harness::TemporaryFolder folder;
  harness::PreparedRun run = prepared(loaded, registry);
  run.plan.folder = folder.path();
  run.plan.quiet = true;
  harness::write_world(run.plan.folder, loaded.world, loaded.resolved);
  return harness::execute_in_detail(run);
}

/// Runs a world with many seeds. Returns the comparison as `seifbed compare --json` prints it.
std::string compare(const std::filesystem::path& name, const Overrides& overrides,
                    const std::vector<std::uint64_t>& seeds, const std::string& baseline, int jobs,
                    bool quiet, const seif::Registry& registry) {
  const Loaded loaded = load(name, overrides, registry);
  harness::Comparison comparison;
  comparison.name = loaded.world.name;
  comparison.baseline = harness::choose_baseline(baseline, loaded.world.estimators);
  std::vector<harness::PlannedRun> planned;
  for (const std::uint64_t seed : seeds)
    planned.push_back({fmt::format("{}-{}", comparison.name, seed),
                       [&, seed] { return run_seed(name, overrides, seed, registry); }});
  harness::FinishedRuns finished = harness::execute_all(planned, jobs, quiet);
  comparison.runs = std::move(finished.runs);
  comparison.interrupted = finished.interrupted;
  harness::compare_estimators(comparison);
  return harness::to_json(comparison);
}

/// Films a run. Returns (the number of frames, whether Ctrl-C ended it).
std::pair<std::int64_t, bool> film(const std::filesystem::path& run, const std::filesystem::path& file,
                                   const Overrides& overrides, std::optional<double> from,
                                   std::optional<double> to, const seif::Registry& registry) {
  std::vector<worlds::Problem> problems;
  std::optional<harness::FilmableFolder> folder = harness::prepare_film(run, overrides, registry, problems);
  if (!folder) throw harness::BadInput(worlds::to_string(problems.front()));
  const worlds::Film& settings = folder->plan.world.film;
  folder->plan.clock = harness::film_clock(settings, folder->plan.start, folder->plan.end, from, to);
  folder->plan.path = harness::path_area(run, folder->plan.clock.start, folder->plan.clock.end);
  harness::check_frame_sink(file, false, harness::Existing::replace);
  const harness::FilmResult result = harness::film_folder(
      *folder, run, harness::make_frame_sink(file, {settings.width, settings.height, settings.fps}, false),
      true);
  return {result.frames, result.interrupted};
}

/// Calls a function while other threads of Python run. They may add estimators, so it gets a copy of the known ones.
template <class Call>
auto apart(const Call& call) {
  const seif::Registry registry = known_registry();
  const LongCall without_python;
  return call(registry);
}

}  // namespace

void bind_runs(py::module_& module) {
  using namespace py::literals;
  module.def(
      "run",
      [](const std::filesystem::path& name, const Overrides& overrides, const std::filesystem::path& folder,
         bool quiet) {
        return apart(
            [&](const seif::Registry& registry) { return run(name, overrides, folder, quiet, registry); });
      },
      "world"_a, "overrides"_a, "folder"_a, "quiet"_a);
  module.def(
      "compare",
      [](const std::filesystem::path& name, const Overrides& overrides,
         const std::vector<std::uint64_t>& seeds, const std::string& baseline, int jobs, bool quiet) {
        return apart([&](const seif::Registry& registry) {
          return compare(name, overrides, seeds, baseline, jobs, quiet, registry);
        });
      },
      "world"_a, "overrides"_a, "seeds"_a, "baseline"_a, "jobs"_a, "quiet"_a);
  module.def(
      "film",
      [](const std::filesystem::path& run, const std::filesystem::path& file, const Overrides& overrides,
         std::optional<double> start, std::optional<double> end) {
        return apart(
            [&](const seif::Registry& registry) { return film(run, file, overrides, start, end, registry); });
      },
      "run"_a, "file"_a, "overrides"_a, "start"_a, "end"_a);
  module.def(
      "resolve",
      [](const std::filesystem::path& name, const Overrides& overrides) {
        return load(name, overrides, known_registry()).resolved;
      },
      "world"_a, "overrides"_a);
  module.def("find_world", &worlds::find_world, "name"_a);
  module.def(
      "load_plugin",
      [](const std::filesystem::path& library) { harness::add_plugin(library, known_registry()); },
      "library"_a);
  module.def(
      "add_estimator",
      [](const std::string& name, const std::string& help, const py::dict& defaults, const py::object& make) {
        add_python_estimator(known_registry(), name, help, defaults, make);
      },
      "name"_a, "help"_a, "defaults"_a, "make"_a);
}

}  // namespace seifbed
