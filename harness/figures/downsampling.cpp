#include "harness/figures/downsampling.hpp"

#include <algorithm>

namespace harness {

namespace {

void keep(const Points& points, std::size_t i, Points& kept) {
  kept.x.push_back(points.x[i]);
  kept.y.push_back(points.y[i]);
}

}  // namespace

Points smallest_and_largest(Points points, std::size_t bins) {
  const std::size_t count = points.x.size();
  if (count <= 2 * bins) return points;
  const double first = points.x.front();
  const double width = (points.x.back() - first) / static_cast<double>(bins);
  Points kept;
  for (std::size_t begin = 0, bin = 1; begin < count; ++bin) {
    std::size_t end = begin;
    while (end < count && (bin >= bins || points.x[end] < first + width * static_cast<double>(bin))) ++end;
    if (end == begin) continue;  // no points in this bin
    const auto at = [&](std::size_t i) { return points.y.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto [low, high] = std::minmax_element(at(begin), at(end));
    const auto lowest = static_cast<std::size_t>(low - at(0));
    const auto highest = static_cast<std::size_t>(high - at(0));
    keep(points, points.y[lowest] < points.y[highest] ? std::min(lowest, highest) : lowest, kept);
    if (points.y[lowest] < points.y[highest]) keep(points, std::max(lowest, highest), kept);
    begin = end;
  }
  return kept;
}

Points thinned(Points points, std::size_t most) {
  const std::size_t count = points.x.size();
  if (count <= most) return points;
  Points kept;
  for (std::size_t i = 0; i < most; ++i) keep(points, i * (count - 1) / (most - 1), kept);
  return kept;
}

}  // namespace harness
