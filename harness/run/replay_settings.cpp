#include "harness/run/replay_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/estimators/registry.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/readers/open_log.hpp"
#include "harness/run/overrides.hpp"
#include "worlds/check.hpp"
#include "worlds/describe.hpp"
#include "worlds/merge.hpp"

namespace harness {

namespace {

/// The settings of the log, or the defaults.
std::optional<worlds::Node> read_settings(const std::filesystem::path& log, const ReplayChoices& choices,
                                          std::vector<worlds::Problem>& problems) {
  for (const char* file : {"world.yaml", "replay.yaml"}) {
    if (std::filesystem::exists(log / file)) return worlds::read_document(log / file, problems);
  }
  const std::string defaults = choices.defaults.empty() ? default_settings(LogFormat::own) : choices.defaults;
  return worlds::parse_document(defaults, "settings", problems);
}

void check_override(const std::string& assignment) {
  const std::string_view path = std::string_view(assignment).substr(0, assignment.find('='));
  const std::string_view section = path.substr(0, path.find('.'));
  for (const char* settable : {"estimators", "scoring", "film", "seed"}) {
    if (section == settable) return;
  }
  throw BadInput(
      fmt::format("--set {}: a replay can set estimators, scoring, film, seed and noise, as in "
                  "scoring.interval_s=2; the rest "
                  "is recorded",
                  assignment));
}

/// Keeps the estimators that were asked for, in the order of the file. Adds a registered type that the file
/// does not have, with its default options.
void select_estimators(worlds::Node& document, const std::vector<std::string>& names,
                       const seif::Registry& registry, std::vector<worlds::Problem>& problems) {
  if (names.empty()) return;
  for (const std::string& name : names) {
    if (worlds::find_path(document, "estimators." + name) != nullptr) continue;
    if (registry.find(name) == nullptr) throw no_such_estimator(registry, "--estimators", name);
    worlds::apply_override(document, fmt::format("estimators.{}={{}}", name), problems);
  }
  worlds::Node* estimators = document.find("estimators");
  if (estimators == nullptr) return;
  std::erase_if(estimators->entries, [&](const worlds::Node::Entry& entry) {
    return std::ranges::find(names, entry.key) == names.end();
  });
}

}  // namespace

worlds::LoadResult load_replay_settings(const std::filesystem::path& log, const ReplayChoices& choices,
                                        const seif::Registry& registry) {
  worlds::LoadResult result;
  std::optional<worlds::Node> document = read_settings(log, choices, result.problems);
  worlds::WorldFile file;
  if (document) {
    std::vector<std::string> overrides = choices.overrides;
    if (!choices.seed.empty()) add_override(overrides, "--seed", "seed", choices.seed);
    for (const std::string& assignment : overrides) {
      check_override(assignment);
      worlds::apply_override(*document, assignment, result.problems);
    }
    worlds::find_libraries(log / "replay.yaml", *document);
    select_estimators(*document, choices.estimators, registry, result.problems);
    const worlds::EstimatorSchemas schemas = estimator_schemas(registry);
    worlds::read_fields(
        *document, [&](worlds::Fields& fields) { worlds::describe_world(fields, file, schemas); },
        result.problems);
  }
  if (document && choices.estimators.empty()) worlds::check_film(*document, file.world, result.problems);
  if (!result.problems.empty()) return result;
  result.world = std::move(file.world);
  result.resolved = worlds::emit(*document);
  return result;
}

std::string settings_of_replay(const std::string& resolved) {
  std::vector<worlds::Problem> problems;
  worlds::Node document = worlds::parse_document(resolved, "settings", problems).value();
  std::erase_if(document.entries, [](const worlds::Node::Entry& entry) {
    return entry.key != "estimators" && entry.key != "scoring" && entry.key != "film" && entry.key != "seed";
  });
  return worlds::emit(document);
}

}  // namespace harness
