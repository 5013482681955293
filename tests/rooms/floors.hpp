// The floors of harness/: a sub-room may include files of lower floors and its own, so that no arrow runs upwards
// and no circle can arise. Each check returns what breaks the rule, as `path:line: what is wrong`.
#pragma once

#include <string>
#include <vector>

#include "rules.hpp"
#include "source.hpp"

namespace rooms {

/// Includes from one sub-room of harness/ of another on the same floor or a higher one, and files of harness/
/// that stand in no sub-room on a floor.
Findings check_floors(const Source& source);

/// More files at the top of harness/ than a stranger takes in at a glance.
Findings check_top_of_harness(const std::vector<std::string>& paths);

}  // namespace rooms
