// Whether the faults of a world fit the rest of it.
#pragma once

#include <string>
#include <vector>

#include "worlds/document.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// Checks that a kidnapped robot is put on the ground and clear of obstacles and of the landmarks placed by
/// hand (generated landmarks are not checked), that what appears can appear, and that outliers are less than half a
/// turn.
void check_faults(const Node& document, const World& world, std::vector<Problem>& problems);

/// Why no such ice, wall or landmark can appear in the world; empty if it can, and for other kinds of faults. Where the
/// robot is by then nobody knows.
std::string why_it_cannot_appear(const Fault& fault, const World& world);

/// Why the robot cannot be put there; empty if it can.
std::string why_it_has_no_room(const Placement& robot, const World& world);

}  // namespace worlds
