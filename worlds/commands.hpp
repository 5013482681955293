// Recorded velocity commands.
#pragma once

#include <filesystem>
#include <vector>

#include "worlds/document.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// Reads a CSV file with the header `t,v,omega` [s, m/s, rad/s]. The times start at 0 or later and grow from
/// row to row. Adds a problem for each row that is wrong; use the result only if there is no problem.
std::vector<VelocityCommand> read_commands(const std::filesystem::path& file, std::vector<Problem>& problems);

/// The same for the file of a takeover, in which both v and omega of a row may be empty.
std::vector<Takeover> read_takeover(const std::filesystem::path& file, std::vector<Problem>& problems);

}  // namespace worlds
