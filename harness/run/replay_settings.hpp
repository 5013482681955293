// What a replay takes from a world file: estimators, scoring, film and seed. The rest stands in the log.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

/// The choices of a command line.
struct ReplayChoices {
  std::vector<std::string> estimators;  // only these: names from world.yaml, or types; empty: all of the file
  std::vector<std::string> overrides;   // path.to.key=value, of estimators, scoring, film and seed
  std::string seed;                     // checked as part of the settings; empty: the file's
  std::string defaults = {};            // settings of a log that comes without; empty: those of our own
};

/// From the world.yaml or the replay.yaml of the log; for a log without, as `choices` or, if they do not say,
/// as the format tells. Throws BadInput for an unknown choice.
worlds::LoadResult load_replay_settings(const std::filesystem::path& log, const ReplayChoices& choices,
                                        const seif::Registry& registry);

/// The resolved settings that concern a replay, for a replay.yaml.
std::string settings_of_replay(const std::string& resolved);

}  // namespace harness
