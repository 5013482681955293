// Recorded velocity commands.
#pragma once

#include <filesystem>
#include <vector>

#include "worlds/document.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// Reads a CSV file with the head `t,v,omega` [s, m/s, rad/s]. The times are at least 0 and grow from row to
/// row. Adds a problem for each row that is wrong; what comes back counts only if there is none.
std::vector<VelocityCommand> read_commands(const std::filesystem::path& file, std::vector<Problem>& problems);

}  // namespace worlds
