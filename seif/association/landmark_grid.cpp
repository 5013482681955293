#include "seif/association/landmark_grid.hpp"

#include <algorithm>
#include <cmath>

namespace seif {

LandmarkGrid::Cell LandmarkGrid::cell_of(const Eigen::Vector2d& p_world) const {
  constexpr double farthest = 1e15;  // [-] cells; what has diverged must not overflow
  const auto number = [&](double x) {
    return static_cast<std::int64_t>(std::floor(std::clamp(x / cell_, -farthest, farthest)));
  };
  return {number(p_world.x()), number(p_world.y())};
}

std::uint64_t LandmarkGrid::hash_of(const Cell& cell) {
  return mixed(static_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(cell.y));
}

void LandmarkGrid::add(const Eigen::Vector2d& p_world) {
  landmarks_.push_back({.p_world = p_world, .cell = cell_of(p_world)});
  lists_.add(hash_of(cell_of(p_world)));
}

void LandmarkGrid::move(LandmarkId i, const Eigen::Vector2d& p_world) {
  if (!lists_.is_in(i)) return;
  landmark(i).p_world = p_world;
  const Cell cell = cell_of(p_world);
  if (cell == landmark(i).cell) return;
  landmark(i).cell = cell;
  lists_.move(i, hash_of(cell));
}

void LandmarkGrid::remove(LandmarkId i) { lists_.remove(i); }

/// Visits the landmarks of the cells whose larger distance in x or y from the centre is `ring`.
template <class Visit>
void LandmarkGrid::for_each_in_ring(const Cell& centre, int ring, Visit&& visit) const {
  for (int dy = -ring; dy <= ring; ++dy) {
    const int step = ring == 0 || std::abs(dy) == ring ? 1 : 2 * ring;
    for (int dx = -ring; dx <= ring; dx += step) {
      const Cell cell{centre.x + dx, centre.y + dy};
      lists_.for_each(hash_of(cell), [&](int i) {
        if (landmark(i).cell == cell) visit(i);
      });
    }
  }
}

void LandmarkGrid::find_near(const Eigen::Vector2d& p_world, double radius, std::size_t max_count,
                             std::vector<Near>& out) const {
  out.clear();
  if (!p_world.allFinite() || landmarks_.size() == 0) return;
  const Cell centre = cell_of(p_world);
  for (int ring = 0; ring <= most_rings; ++ring) {
    // Whatever is in this ring is at least so far away.
    const double least = (ring - 1) * cell_;
    if (least > radius || (out.size() >= max_count && out[max_count - 1].distance <= least)) break;
    for_each_in_ring(centre, ring, [&](int i) {
      const double distance = (landmark(i).p_world - p_world).norm();
      if (distance <= radius) out.push_back({i, distance});
    });
    std::ranges::sort(out, [](const Near& a, const Near& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.landmark < b.landmark;
    });
    if (out.size() > max_count) out.resize(max_count);
  }
}

}  // namespace seif
