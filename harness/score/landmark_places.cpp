#include "harness/score/landmark_places.hpp"

#include <algorithm>
#include <cmath>
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

}  // namespace

LandmarkPlaces::LandmarkPlaces(std::vector<Eigen::Vector2d> points)
    : points_(std::move(points)), grid_(cell_for(points_)) {
  for (const Eigen::Vector2d& p : points_) grid_.add(p);
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
  return static_cast<std::size_t>(found.front().landmark);
}

const std::vector<LandmarkPlaces::Near>& LandmarkPlaces::near(const Eigen::Vector2d& p, double radius,
                                                              std::size_t most) const {
  grid_.find_near(p, radius, most, near_);
  return near_;
}

}  // namespace harness
