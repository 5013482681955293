#include "harness/stream/read_counts.hpp"

namespace harness {

std::vector<std::pair<std::string_view, std::int64_t>> named(const ReadCounts& counts) {
  std::vector<std::pair<std::string_view, std::int64_t>> all = {
      {"unknown_ids", counts.unknown_ids},
      {"robots", counts.robots},
      {"repeated", counts.repeated},
      {"not_finite", counts.not_finite},
      {"negative_ranges", counts.negative_ranges},
      {"backwards", counts.backwards},
      {"without_odometry", counts.without_odometry},
      {"odometry_gaps", counts.odometry_gaps},
      {"scans_after_odometry", counts.scans_after_odometry},
      {"truth_gaps", counts.truth_gaps}};
  std::erase_if(all, [](const auto& count) { return count.second == 0; });
  return all;
}

}  // namespace harness
