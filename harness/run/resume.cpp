#include "harness/run/resume.hpp"

#include <fmt/format.h>

#include "harness/files/bad_input.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/run/repetition.hpp"
#include "harness/run/runnable_world.hpp"

namespace harness {

namespace fs = std::filesystem;

bool is_incomplete(const fs::path& run) {
  if (!fs::exists(run / "world.yaml"))
    throw BadInput(fmt::format("{}: is no folder of a run: it has no world.yaml", run.string()));
  if (is_going_on(run))
    throw BadInput(fmt::format("{}: is still going on: there is nothing to resume", run.string()));
  return is_unfinished(run) || read_summary(run / "summary.json").interrupted;
}

RunResult resume(const fs::path& run, const seif::Registry& registry, bool quiet) {
  const worlds::LoadResult loaded = load_runnable_world(run / "world.yaml", {}, registry);
  if (!loaded.world) throw BadInput(worlds::to_string(loaded.problems.front()));
  const Workshop workshop(run);
  PreparedRun again = prepare_run(*loaded.world, registry);
  again.plan.folder = workshop.path();
  again.plan.quiet = quiet;
  RunResult result = execute(again);
  if (!result.error.empty() || result.summary.interrupted) return result;
  take_place(workshop.path(), run);
  return result;
}

}  // namespace harness
