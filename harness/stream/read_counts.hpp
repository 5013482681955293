// Counts what the reader of a log left out or bridged. Real logs have errors, and the scores report them.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace harness {

/// The counts so far. [-]
struct ReadCounts {
  std::int64_t unknown_ids = 0;       // observations of an id that no table of the log has: left out
  std::int64_t robots = 0;            // observations of another robot: left out
  std::int64_t repeated = 0;          // second observations of a landmark in the same scan: left out
  std::int64_t not_finite = 0;        // rows with a NaN or an infinity: left out
  std::int64_t negative_ranges = 0;   // observations with a negative range: left out
  std::int64_t backwards = 0;         // rows with an earlier time than the row above: left out
  std::int64_t without_odometry = 0;  // observations before the first or after the last odometry: left out
  std::int64_t odometry_gaps = 0;     // gaps above the reader's limit: the last command continues
  std::int64_t scans_after_odometry =
      0;                        // scans more than 1 s after the last odometry: taken, without motion
  std::int64_t truth_gaps = 0;  // gaps above the reader's limit: the truth is not known in them
};

/// The counts that are not zero, with their names in the scores.
std::vector<std::pair<std::string_view, std::int64_t>> named(const ReadCounts& counts);

}  // namespace harness
