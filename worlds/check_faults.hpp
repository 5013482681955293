// Whether the faults of a world fit the rest of it.
#pragma once

#include <vector>

#include "worlds/document.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// Checks that a kidnapped robot is put on the ground and clear of obstacles and of the landmarks placed by
/// hand (generated landmarks are not checked), and that outliers are less than half a turn.
void check_faults(const Node& document, const World& world, std::vector<Problem>& problems);

}  // namespace worlds
