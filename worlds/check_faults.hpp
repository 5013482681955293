// Whether the faults of a world fit the rest of it.
#pragma once

#include <vector>

#include "worlds/document.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// Checks where the robot is put, as far as that is not generated, and that outliers are less than half a
/// turn.
void check_faults(const Node& document, const World& world, std::vector<Problem>& problems);

}  // namespace worlds
