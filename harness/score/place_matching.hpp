// Finds the world's landmark behind each landmark of a map by its place alone, for maps whose landmarks have
// names that nobody recorded. Definitions: docs/scores.md.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "harness/stream/run_listener.hpp"
#include "harness/stream/stream.hpp"

namespace harness {

/// For each landmark of the map, the id of the world's landmark that lies there; no_landmark if none does. One
/// to one. `T_true_est` is a guess of how the map lies in the world, for instance from the trajectories;
/// without one, or if it does not fit, the map is searched for in the world. The result is empty if no
/// position of the map fits, or several do. The same arguments give the same result. The work is O(n log n).
std::optional<std::vector<seif::LandmarkId>> match_by_place(std::span<const MapRecord> map,
                                                            std::span<const TrueLandmark> truth,
                                                            const std::optional<seif::Pose2>& T_true_est);

}  // namespace harness
