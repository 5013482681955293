// Landmarks and observations row by row: what the readers of other formats share.
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

/// By their ids, which the file calls `name`. Throws BadInput if one stands there twice.
void sort_by_id(std::vector<TrueLandmark>& landmarks, const std::filesystem::path& file,
                std::string_view name);

/// Without observations yet.
void begin_scan(ScanEvent& event, double t, const std::optional<TruePose>& truth);

/// Unless the scan has the landmark already: then it is counted and left out.
void add_once(const seif::Observation& observation, ScanEvent& event, ReadCounts& counts);

}  // namespace harness
