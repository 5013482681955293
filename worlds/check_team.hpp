// Checks whether the robots of a team fit together and with their world.
#pragma once

#include <vector>

#include "worlds/document.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// Adds what is wrong to the problems. What each robot has of its own is checked elsewhere (check_world).
void check_team(const Node& document, const World& world, std::vector<Problem>& problems);

}  // namespace worlds
