// What a replay takes from a world file: estimators, scoring, film and seed. The rest stands in the log.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

/// What a command line says about them.
struct ReplayChoices {
  std::vector<std::string> estimators;  // only these: names from world.yaml, or types; empty: all of the file
  std::vector<std::string> overrides;   // path.to.key=value, of estimators, scoring, film and seed
  std::string seed;                     // checked as part of the settings; empty: the file's
};

/// From the world.yaml of the log; for a log without one, `ekf`, `seif` and `seif_report`. Throws BadInput
/// for a choice that is none.
worlds::LoadResult load_replay_settings(const std::filesystem::path& log, const ReplayChoices& choices,
                                        const seif::Registry& registry);

}  // namespace harness
