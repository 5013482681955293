#include "harness/score/map_counts.hpp"

#include <algorithm>
#include <vector>

#include "harness/statistics/alignment.hpp"

namespace harness {

namespace {

const TrueLandmark* find(std::span<const TrueLandmark> truth, seif::LandmarkId id) {
  const auto it = std::ranges::lower_bound(truth, id, {}, &TrueLandmark::landmark);
  return it == truth.end() || it->landmark != id ? nullptr : &*it;
}

}  // namespace

MapCounts count_landmarks(std::span<const MapRecord> map, std::span<const TrueLandmark> truth,
                          const std::optional<std::set<seif::LandmarkId>>& seen) {
  std::set<seif::LandmarkId> mapped;
  std::vector<Eigen::Vector2d> est_points;
  std::vector<Eigen::Vector2d> true_points;
  std::vector<Eigen::Vector2d> spurious;
  for (const MapRecord& landmark : map) {
    const TrueLandmark* found = find(truth, landmark.landmark);
    if (found == nullptr) {
      spurious.push_back(landmark.mean);
      continue;
    }
    mapped.insert(landmark.landmark);
    est_points.push_back(landmark.mean);
    true_points.push_back(found->position);
  }
  MapCounts counts;
  counts.spurious = static_cast<int>(spurious.size());
  const seif::Pose2 T_true_est = align(est_points, true_points).value_or(seif::Pose2{});
  const auto is_duplicate = [&](const Eigen::Vector2d& p_est) {
    const Eigen::Vector2d p_true = T_true_est * p_est;
    return std::ranges::any_of(
        true_points, [&](const Eigen::Vector2d& p) { return (p - p_true).norm() <= duplicate_radius; });
  };
  counts.duplicate = static_cast<int>(std::ranges::count_if(spurious, is_duplicate));
  if (seen) {
    const auto is_missed = [&](seif::LandmarkId id) { return !mapped.contains(id); };
    counts.missed = static_cast<int>(std::ranges::count_if(*seen, is_missed));
  }
  return counts;
}

}  // namespace harness
