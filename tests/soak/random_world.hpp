// Worlds and settings that nobody thought of.
#pragma once

#include <cstdint>
#include <string>

namespace soak {

/// A world file, from a seed: engine, ground, landmarks, obstacles, drive, sensors, faults, estimators and
/// their options. Not every one of them has room for what it asks for.
std::string random_world(std::uint64_t seed);

}  // namespace soak
