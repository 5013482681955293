// Rectangles in a grid of square cells. Finding the rectangles near a place costs the same among ten and among
// ten thousand.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "worlds/geometry.hpp"

namespace worlds {

class ShapeGrid {
 public:
  /// `reach` [m]: roughly the largest reach of the shapes; a larger one only costs time.
  ShapeGrid(const Eigen::Vector2d& ground_size, double reach);

  /// Adds a shape. Shapes are numbered in the order in which they are added. any_near() finds this one within
  /// `reach` [m] of it.
  void add(const Rectangle& shape, double reach);

  /// Whether any(index, shape) is true for a shape within its reach of p. `any` is also called for some shapes
  /// farther away.
  template <class Predicate>
  bool any_near(const Eigen::Vector2d& p, const Predicate& any) const {
    for (const std::int32_t i : by_cell_[index_of(cell_of(p))]) {
      if (any(static_cast<std::size_t>(i), shapes_[static_cast<std::size_t>(i)])) return true;
    }
    return false;
  }

 private:
  void enter(const Rectangle& shape, double reach, std::int32_t index);
  Eigen::Array2i cell_of(const Eigen::Vector2d& p) const;

  std::size_t index_of(const Eigen::Array2i& cell) const {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(cells_.x()) +
           static_cast<std::size_t>(cell.x());
  }

  Eigen::Vector2d ground_size_;  // [m]
  double cell_;                  // [m] edge of a cell
  Eigen::Array2i cells_;         // [-] columns, rows
  std::vector<Rectangle> shapes_;
  std::vector<std::vector<std::int32_t>> by_cell_;  // (columns * rows)
};

}  // namespace worlds
