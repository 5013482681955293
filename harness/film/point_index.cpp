#include "harness/film/point_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace harness {

std::int32_t PointIndex::column(double coordinate) const {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(std::floor(coordinate / cell_), -most, most));
}

PointIndex::Key PointIndex::key(std::int32_t column, std::int32_t row) {
  return (Key{static_cast<std::uint32_t>(column)} << 32U) | static_cast<std::uint32_t>(row);
}

PointIndex::Key PointIndex::key(const Eigen::Vector2d& position) const {
  return key(column(position.x()), column(position.y()));
}

void PointIndex::put(seif::LandmarkId id, const Eigen::Vector2d& position) {
  const auto [known, is_new] = numbers_.try_emplace(id, points_.size());
  if (is_new) points_.push_back({id, position});
  Point& point = points_[known->second];
  const Key from = key(point.position);
  const Key to = key(position);
  point.position = position;
  if (!is_new && from == to) return;
  if (!is_new) std::erase(cells_[from], id);
  cells_[to].push_back(id);
}

std::optional<Eigen::Vector2d> PointIndex::position(seif::LandmarkId id) const {
  const auto known = numbers_.find(id);
  if (known == numbers_.end()) return std::nullopt;
  return points_[known->second].position;
}

void PointIndex::within(const Area& area, std::vector<seif::LandmarkId>& out) const {
  out.clear();
  const std::int32_t first_column = column(area.min.x());
  const std::int32_t last_column = column(area.max.x());
  const std::int32_t first_row = column(area.min.y());
  const std::int32_t last_row = column(area.max.y());
  const double cells = (double{1} + last_column - first_column) * (double{1} + last_row - first_row);
  if (cells > static_cast<double>(cells_.size())) {  // then a pass over all points is cheaper
    for (const Point& point : points_) {
      if ((point.position.array() >= area.min.array()).all() &&
          (point.position.array() <= area.max.array()).all())
        out.push_back(point.id);
    }
    return;
  }
  for (std::int32_t c = first_column; c <= last_column; ++c) {
    for (std::int32_t r = first_row; r <= last_row; ++r) {
      const auto cell = cells_.find(key(c, r));
      if (cell != cells_.end()) out.insert(out.end(), cell->second.begin(), cell->second.end());
    }
  }
}

}  // namespace harness
