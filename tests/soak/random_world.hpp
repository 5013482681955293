// Random worlds and settings, for combinations that nobody has thought of.
#pragma once

#include <cstdint>
#include <string>

namespace soak {

/// A world file from a seed: engine, ground, landmarks, obstacles, drive, sensors, faults, estimators and their
/// options are random. Some of these worlds have no room for everything that they ask for.
std::string random_world(std::uint64_t seed);

}  // namespace soak
