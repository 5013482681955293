// Points in a hashed grid of square cells: finding those near a place costs the same among a hundred and a
// million.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace worlds {

class PointGrid {
 public:
  /// `reach` [m]: the largest distance that will be asked about; > 0.
  explicit PointGrid(double reach) : cell_(reach), heads_(64, nobody) {}

  /// Points are numbered in the order in which they come.
  void add(const Eigen::Vector2d& point) {
    if (points_.size() == heads_.size()) grow();
    points_.push_back(point);
    next_.push_back(nobody);
    link(points_.size() - 1);
  }

  /// Whether any(index, position) is true for a point within `reach` of p. It is asked about some beyond,
  /// too.
  template <class Predicate>
  bool any_near(const Eigen::Vector2d& p, const Predicate& any) const {
    const std::int64_t column = cell_of(p.x());
    const std::int64_t row = cell_of(p.y());
    for (std::int64_t x = column - 1; x <= column + 1; ++x) {
      for (std::int64_t y = row - 1; y <= row + 1; ++y) {
        for (std::int32_t i = heads_[bucket(x, y)]; i != nobody; i = next_[static_cast<std::size_t>(i)]) {
          if (any(static_cast<std::size_t>(i), points_[static_cast<std::size_t>(i)])) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr std::int32_t nobody = -1;

  std::int64_t cell_of(double coordinate) const {
    return static_cast<std::int64_t>(std::floor(coordinate / cell_));
  }

  /// Large odd factors spread neighbouring cells (Teschner et al., "Optimized Spatial Hashing for Collision
  /// Detection of Deformable Objects", 2003).
  std::size_t bucket(std::int64_t column, std::int64_t row) const {
    const std::uint64_t hash =
        static_cast<std::uint64_t>(column) * 73856093U ^ static_cast<std::uint64_t>(row) * 19349663U;
    return static_cast<std::size_t>(hash) & (heads_.size() - 1);
  }

  void link(std::size_t index) {
    std::int32_t& head = heads_[bucket(cell_of(points_[index].x()), cell_of(points_[index].y()))];
    next_[index] = head;
    head = static_cast<std::int32_t>(index);
  }

  void grow() {
    heads_.assign(2 * heads_.size(), nobody);
    for (std::size_t i = 0; i < points_.size(); ++i) link(i);
  }

  double cell_;                      // [m] edge of a cell
  std::vector<std::int32_t> heads_;  // for each bucket the last point in it; a power of two of them
  std::vector<std::int32_t> next_;   // for each point the one before it in its bucket
  std::vector<Eigen::Vector2d> points_;
};

}  // namespace worlds
