#include "seif/association/landmark_grid.hpp"

#include <algorithm>
#include <cmath>

namespace seif {
namespace {

/// Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014: its mixing function.
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

}  // namespace

LandmarkGrid::Cell LandmarkGrid::cell_of(const Eigen::Vector2d& p_world) const {
  constexpr double farthest = 1e15;  // [-] cells; what has diverged must not overflow
  const auto number = [&](double x) {
    return static_cast<std::int64_t>(std::floor(std::clamp(x / cell_, -farthest, farthest)));
  };
  return {number(p_world.x()), number(p_world.y())};
}

/// Lists below next_split_ have been split in this round, so one more bit of the hash counts.
std::size_t LandmarkGrid::list_of(const Cell& cell) const {
  const std::uint64_t hash =
      mixed(static_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(cell.y));
  const std::size_t list = hash & (round_ - 1);
  return list < next_split_ ? hash & (2 * round_ - 1) : list;
}

void LandmarkGrid::put_in(int i) {
  int& head = lists_[list_of(landmark(i).cell)];
  landmark(i).next = head;
  landmark(i).is_in = true;
  head = i;
}

void LandmarkGrid::take_out(int i) {
  int* link = &lists_[list_of(landmark(i).cell)];
  while (*link != i) link = &landmark(*link).next;
  *link = landmark(i).next;
  landmark(i).is_in = false;
}

void LandmarkGrid::split() {
  const std::size_t from = next_split_;
  int i = lists_[from];
  lists_[from] = none;
  lists_.push_back(none);
  if (++next_split_ == round_) {
    round_ *= 2;
    next_split_ = 0;
  }
  while (i != none) {
    const int next = landmark(i).next;
    put_in(i);
    i = next;
  }
}

void LandmarkGrid::add(const Eigen::Vector2d& p_world) {
  const auto i = static_cast<int>(landmarks_.size());
  landmarks_.push_back({.p_world = p_world, .cell = cell_of(p_world)});
  put_in(i);
  if (landmarks_.size() > landmarks_per_list * lists_.size()) split();
}

void LandmarkGrid::move(LandmarkId i, const Eigen::Vector2d& p_world) {
  if (!landmark(i).is_in) return;
  landmark(i).p_world = p_world;
  const Cell cell = cell_of(p_world);
  if (cell == landmark(i).cell) return;
  take_out(i);
  landmark(i).cell = cell;
  put_in(i);
}

void LandmarkGrid::remove(LandmarkId i) {
  if (landmark(i).is_in) take_out(i);
}

/// Visits the landmarks of the cells whose larger distance in x or y from the centre is `ring`.
template <class Visit>
void LandmarkGrid::for_each_in_ring(const Cell& centre, int ring, Visit&& visit) const {
  for (int dy = -ring; dy <= ring; ++dy) {
    const int step = ring == 0 || std::abs(dy) == ring ? 1 : 2 * ring;
    for (int dx = -ring; dx <= ring; dx += step) {
      const Cell cell{centre.x + dx, centre.y + dy};
      for (int i = lists_[list_of(cell)]; i != none; i = landmark(i).next) {
        if (landmark(i).cell == cell) visit(i);
      }
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
