// Reads a single fault, for a program that injects one while a run goes on.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "worlds/document.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// Reads a fault from YAML, as in the list `faults` of a world file, and checks it against the world. Adds what is
/// wrong to `problems`; then there is no result. Its numbers are those that a file with this text gives, to the bit.
std::optional<Fault> read_fault(std::string_view yaml, const World& world, std::vector<Problem>& problems);

}  // namespace worlds
