#include "harness/team/team_resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/run/repetition.hpp"
#include "harness/run/runnable_world.hpp"
#include "harness/team/team.hpp"
#include "harness/team/team_run.hpp"
#include "worlds/document.hpp"
#include "worlds/merge.hpp"

namespace harness {

namespace fs = std::filesystem;

bool is_team(const fs::path& run) {
  if (!fs::exists(run / "world.yaml")) return false;
  std::vector<worlds::Problem> problems;
  const std::optional<worlds::Node> document = worlds::read_document(run / "world.yaml", problems);
  const worlds::Node* robots = document ? worlds::find_path(*document, "robots") : nullptr;
  return robots != nullptr && !robots->items.empty();
}

std::optional<TeamResult> resume_team(const fs::path& run, const seif::Registry& registry, bool quiet) {
  if (is_going_on(run))
    throw BadInput(fmt::format("{}: is still going on: there is nothing to resume", run.string()));
  if (!is_unfinished(run) && !is_part_of_a_run(run / "summary.json")) return std::nullopt;
  const worlds::LoadResult loaded = load_runnable_world(run / "world.yaml", {}, registry);
  if (!loaded.world) throw BadInput(worlds::to_string(loaded.problems.front()));
  const Workshop workshop(run);
  Team again = prepare_team(*loaded.world, registry);
  open_team_folder(again, workshop.path(), *loaded.world, loaded.resolved);
  TeamResult result = execute(again, workshop.path(), quiet);
  const bool failed = std::ranges::any_of(result.robots, [](const auto& r) { return !r.run.error.empty(); });
  if (!failed && !result.interrupted) take_place(workshop.path(), run);
  return result;
}

}  // namespace harness
