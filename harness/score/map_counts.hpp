// Counts the landmarks that a map misses, and those that it has too many. Definitions: docs/scores.md.
#pragma once

#include <optional>
#include <set>
#include <span>

#include "harness/stream/run_listener.hpp"
#include "harness/stream/stream.hpp"

namespace harness {

struct MapCounts {
  std::optional<int> missed;  // [-] landmarks that were seen and are not in the map
  int spurious = 0;           // [-] landmarks in the map that the world does not have
  int duplicate = 0;          // [-] spurious landmarks that lie near a landmark that the map already has
};

/// A spurious landmark within this distance of a correctly mapped one is a duplicate, after the alignment of
/// map and world. [m]
inline constexpr double duplicate_radius = 0.5;

/// `truth` is sorted by id. `seen` holds the ids of the world's landmarks that appear in any scan; empty if
/// that is not known.
MapCounts count_landmarks(std::span<const MapRecord> map, std::span<const TrueLandmark> truth,
                          const std::optional<std::set<seif::LandmarkId>>& seen);

}  // namespace harness
