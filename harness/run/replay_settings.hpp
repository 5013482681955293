// The settings of a replay: estimators, scoring, film and seed, from a world file. The rest comes from the
// log.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

/// The choices of the command line.
struct ReplayChoices {
  std::vector<std::string> estimators;  // only these: names from world.yaml, or types; empty: all of the file
  std::vector<std::string> overrides;   // path.to.key=value, for estimators, scoring, film and seed
  std::string seed;                     // checked together with the settings; empty: the file's seed
  std::string defaults = {};            // for a log without world.yaml or replay.yaml; empty: our own
};

/// Reads the settings from the log's world.yaml or replay.yaml. If the log has neither, it takes those of
/// `choices`, and otherwise the defaults of the log format. Throws BadInput for an invalid choice.
worlds::LoadResult load_replay_settings(const std::filesystem::path& log, const ReplayChoices& choices,
                                        const seif::Registry& registry);

/// The part of resolved settings that a replay needs, as the text of a replay.yaml.
std::string settings_of_replay(const std::string& resolved);

}  // namespace harness
