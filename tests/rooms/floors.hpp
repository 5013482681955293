// The floors of harness/: a sub-room may include only its own files and files of lower floors, so all arrows
// point down and no cycle is possible. Each check returns the violations, as `path:line: what is wrong`.
#pragma once

#include <string>
#include <vector>

#include "rules.hpp"
#include "source.hpp"

namespace rooms {

/// Finds includes from one sub-room of harness/ to another on the same or a higher floor, and files of harness/
/// in a sub-room that is on no floor.
Findings check_floors(const Source& source);

/// Finds out whether there are too many files at the top of harness/ for a quick overview.
Findings check_top_of_harness(const std::vector<std::string>& paths);

}  // namespace rooms
