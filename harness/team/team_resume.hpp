// Completes the run of a team that was interrupted or cut off.
#pragma once

#include <filesystem>
#include <optional>

#include "harness/team/team_summary.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Whether this is the folder of a team's run: its world.yaml has several robots.
bool is_team(const std::filesystem::path& run);

/// As resume() does for a lone robot, whose promises hold for each robot here. Nothing if the run is whole. Throws
/// BadInput if it is still going on.
std::optional<TeamResult> resume_team(const std::filesystem::path& run, const seif::Registry& registry,
                                      bool quiet);

}  // namespace harness
