// Runs a team: all robots move in one world, and each has its own live loop and folder.
#pragma once

#include <filesystem>
#include <string>

#include "harness/team/team.hpp"
#include "harness/team/team_summary.hpp"

namespace harness {

/// Runs, records and scores all robots, and writes summary.json to `folder`, which holds the robots' folders
/// (open_team_folder). SIGINT and SIGTERM end the run and it is still scored. An error of one robot ends the run of
/// all. Throws std::system_error if the run cannot be recorded.
TeamResult execute(Team& team, const std::filesystem::path& folder, bool quiet);

/// As for a lone robot, by the worst of all.
int exit_code(const TeamResult& result);

}  // namespace harness
