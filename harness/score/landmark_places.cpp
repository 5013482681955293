#include "harness/score/landmark_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace harness {

namespace {

constexpr double smallest_cell = 1e-3;  // [m]

/// The length of the interval that holds the middle nine tenths of the values.
double extent(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t rest = values.size() / 20;
  return values[values.size() - 1 - rest] - values[rest];
}

/// About one point for each cell. A few points that lie far away do not count.
double cell_for(const std::vector<Eigen::Vector2d>& points) {
  if (points.empty()) return 1.0;
  std::vector<double> x;
  std::vector<double> y;
  for (const Eigen::Vector2d& p : points) {
    x.push_back(p.x());
    y.push_back(p.y());
  }
  const auto count = static_cast<double>(points.size());
  const double width = extent(std::move(x));
  const double height = extent(std::move(y));
  return std::max({std::sqrt(width * height / count), std::max(width, height) / count, smallest_cell});
}

std::uint64_t key_of(std::int64_t x, std::int64_t y) {
  return static_cast<std::uint64_t>(x) << 32U ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
}

}  // namespace

LandmarkPlaces::LandmarkPlaces(std::vector<Eigen::Vector2d> points)
    : points_(std::move(points)), cell_(cell_for(points_)) {
  for (std::size_t i = 0; i < points_.size(); ++i)
    grid_[key_of(column(points_[i].x()), column(points_[i].y()))].push_back(i);
}

std::int64_t LandmarkPlaces::column(double coordinate) const {
  constexpr double farthest = 1e9;  // [-] cells; keys of cells must not overflow
  return static_cast<std::int64_t>(std::floor(std::clamp(coordinate / cell_, -farthest, farthest)));
}

std::optional<double> LandmarkPlaces::spacing() const {
  std::vector<double> distances;
  for (const Eigen::Vector2d& p : points_) {
    const std::vector<Near>& found = near(p, std::numeric_limits<double>::infinity(), 2);
    if (found.size() == 2) distances.push_back(found[1].distance);
  }
  if (distances.empty()) return std::nullopt;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::ranges::nth_element(distances, middle);
  return *middle;
}

std::optional<std::size_t> LandmarkPlaces::nearest(const Eigen::Vector2d& p, double radius) const {
  const std::vector<Near>& found = near(p, radius, 1);
  if (found.empty()) return std::nullopt;
  return found.front().index;
}

const std::vector<LandmarkPlaces::Near>& LandmarkPlaces::near(const Eigen::Vector2d& p, double radius,
                                                              std::size_t most) const {
  constexpr std::int64_t most_rings = 24;
  near_.clear();
  if (!p.allFinite()) return near_;
  const std::int64_t x = column(p.x());
  const std::int64_t y = column(p.y());
  for (std::int64_t ring = 0; ring <= most_rings; ++ring) {
    // Whatever is in this ring is at least so far away.
    const double least = static_cast<double>(ring - 1) * cell_;
    if (least > radius || (near_.size() >= most && near_[most - 1].distance <= least)) break;
    for (std::int64_t dy = -ring; dy <= ring; ++dy) {
      const std::int64_t step = ring == 0 || std::abs(dy) == ring ? 1 : 2 * ring;
      for (std::int64_t dx = -ring; dx <= ring; dx += step) add_cell(x + dx, y + dy, p, radius);
    }
    std::ranges::sort(near_, {}, [](const Near& found) { return std::pair(found.distance, found.index); });
    if (near_.size() > most) near_.resize(most);
  }
  return near_;
}

void LandmarkPlaces::add_cell(std::int64_t x, std::int64_t y, const Eigen::Vector2d& p, double radius) const {
  const auto cell = grid_.find(key_of(x, y));
  if (cell == grid_.end()) return;
  for (const std::size_t i : cell->second) {
    const double distance = (points_[i] - p).norm();
    if (distance <= radius) near_.push_back({i, distance});
  }
}

}  // namespace harness
