// Landmarks and observations by rows: helpers for the readers of several formats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "harness/stream/read_counts.hpp"
#include "harness/stream/stream.hpp"

namespace harness {

inline constexpr std::int64_t largest_id = std::numeric_limits<seif::LandmarkId>::max() - 1;

/// Sorts by id; the file calls the ids `name`. Throws BadInput if an id occurs twice.
void sort_by_id(std::vector<TrueLandmark>& landmarks, const std::filesystem::path& file,
                std::string_view name);

/// Starts a scan without observations.
void begin_scan(ScanEvent& event, double t, const std::optional<TruePose>& truth);

/// Adds an observation. A second one of the same landmark is counted and left out.
void add_once(const seif::Observation& observation, ScanEvent& event, ReadCounts& counts);

}  // namespace harness
