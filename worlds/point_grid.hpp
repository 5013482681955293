// Points in a hashed grid of square cells. Finding the points near a place costs the same among a hundred and
// among a million.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace worlds {

class PointGrid {
 public:
  /// `reach` [m]: the largest distance for any_near(); > 0.
  explicit PointGrid(double reach) : cell_(reach), heads_(64, nobody) {}

  /// Points are numbered in the order in which they are added.
  void add(const Eigen::Vector2d& point) {
    if (points_.size() == heads_.size()) grow();
    points_.push_back(point);
    next_.push_back(nobody);
    link(points_.size() - 1);
  }

  /// Whether any(index, position) is true for a point within `reach` of p. `any` is also called for some points
  /// farther away, and may be called twice for one point.
  template <class Predicate>
  bool any_near(const Eigen::Vector2d& p, const Predicate& any) const {
    const Cell middle = cell_of(p);
    return any_in_cells({middle.column - 1, middle.row - 1}, {middle.column + 1, middle.row + 1}, any);
  }

  /// The same for any distance; the work grows with (distance / reach)^2.
  template <class Predicate>
  bool any_within(const Eigen::Vector2d& p, double distance, const Predicate& any) const {
    const Eigen::Vector2d half_size(distance, distance);
    return any_in_cells(cell_of(p - half_size), cell_of(p + half_size), any);
  }

 private:
  static constexpr std::int32_t nobody = -1;

  struct Cell {
    std::int64_t column;
    std::int64_t row;
  };

  Cell cell_of(const Eigen::Vector2d& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x() / cell_)),
            static_cast<std::int64_t>(std::floor(p.y() / cell_))};
  }

  template <class Predicate>
  bool any_in_cells(const Cell& first, const Cell& last, const Predicate& any) const {
    for (std::int64_t x = first.column; x <= last.column; ++x) {
      for (std::int64_t y = first.row; y <= last.row; ++y) {
        for (std::int32_t i = heads_[bucket({x, y})]; i != nobody; i = next_[static_cast<std::size_t>(i)]) {
          if (any(static_cast<std::size_t>(i), points_[static_cast<std::size_t>(i)])) return true;
        }
      }
    }
    return false;
  }

  /// Hash with large odd factors, which spread neighbouring cells (Teschner et al., "Optimized Spatial Hashing
  /// for Collision Detection of Deformable Objects", 2003).
  std::size_t bucket(const Cell& cell) const {
    const std::uint64_t hash = static_cast<std::uint64_t>(cell.column) * 73856093U ^
                               static_cast<std::uint64_t>(cell.row) * 19349663U;
    return static_cast<std::size_t>(hash) & (heads_.size() - 1);
  }

  void link(std::size_t index) {
    std::int32_t& head = heads_[bucket(cell_of(points_[index]))];
    next_[index] = head;
    head = static_cast<std::int32_t>(index);
  }

  void grow() {
    heads_.assign(2 * heads_.size(), nobody);
    for (std::size_t i = 0; i < points_.size(); ++i) link(i);
  }

  double cell_;                      // [m] edge of a cell
  std::vector<std::int32_t> heads_;  // for each of the 2^n buckets: its latest point
  std::vector<std::int32_t> next_;   // for each point: the one before it in its bucket
  std::vector<Eigen::Vector2d> points_;
};

}  // namespace worlds
