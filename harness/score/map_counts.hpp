// Counts of missed, spurious and duplicate landmarks of a map. Definitions: docs/scores.md.
#pragma once

#include <set>
#include <span>

#include "harness/stream/run_listener.hpp"
#include "harness/stream/stream.hpp"

namespace harness {

struct MapCounts {
  int missed = 0;     // [-] landmarks that were seen, and are not in the map
  int spurious = 0;   // [-] in the map, and not in the world
  int duplicate = 0;  // [-] spurious ones near a landmark of the world that the map has already
};

/// A spurious landmark this near to another is its duplicate, after the map is aligned to the world. [m]
inline constexpr double duplicate_radius = 0.5;

/// `truth` is sorted by id. `seen` are the ids of the landmarks of the world that any scan holds.
MapCounts count_landmarks(std::span<const MapRecord> map, std::span<const TrueLandmark> truth,
                          const std::set<seif::LandmarkId>& seen);

}  // namespace harness
