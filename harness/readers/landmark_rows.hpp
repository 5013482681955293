// Landmarks and observations row by row, shared by the readers of other formats.
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

/// Landmarks by id; the file calls the id `name`. Throws BadInput for an id that stands there twice.
void sort_by_id(std::vector<TrueLandmark>& landmarks, const std::filesystem::path& file,
                std::string_view name);

/// A scan without observations.
void begin_scan(ScanEvent& event, double t, const std::optional<TruePose>& truth);

/// Adds an observation, unless the scan has the landmark already: then counts and ignores it.
void add_once(const seif::Observation& observation, ScanEvent& event, ReadCounts& counts);

}  // namespace harness
