// Counts of what the reader of a log ignored or bridged. Real logs have errors, and the scores report them.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace harness {

/// The counts so far. [-]
struct ReadCounts {
  std::int64_t unknown_ids = 0;       // observations of an id that no table of the log knows: left out
  std::int64_t robots = 0;            // observations of another robot: left out
  std::int64_t repeated = 0;          // observations of a landmark that the same scan has already: left out
  std::int64_t not_finite = 0;        // rows with a NaN or an infinity: left out
  std::int64_t negative_ranges = 0;   // observations with a range below zero: left out
  std::int64_t backwards = 0;         // rows before the time of the row above: left out
  std::int64_t without_odometry = 0;  // observations before the odometry begins or after it ends: left out
  std::int64_t odometry_gaps = 0;     // longer than the reader's limit: the last command is taken to hold on
  std::int64_t truth_gaps = 0;        // longer than the reader's limit: there is no truth in them
};

/// The counts that are not zero, with their names in the scores.
std::vector<std::pair<std::string_view, std::int64_t>> named(const ReadCounts& counts);

}  // namespace harness
