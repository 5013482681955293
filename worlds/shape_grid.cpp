#include "worlds/shape_grid.hpp"

#include <algorithm>
#include <numbers>

namespace worlds {
namespace {

constexpr double finest_cell = 1.0;    // [m]
constexpr double most_cells = 1000.0;  // [-] across the ground

}  // namespace

ShapeGrid::ShapeGrid(const Eigen::Vector2d& ground_size, double reach)
    : ground_size_(ground_size),
      cell_(std::max({finest_cell, reach, ground_size.maxCoeff() / most_cells})),
      cells_((ground_size.array() / cell_).ceil().cast<int>().max(1)),
      by_cell_(static_cast<std::size_t>(cells_.x()) * static_cast<std::size_t>(cells_.y())) {}

void ShapeGrid::add(const Rectangle& shape, double reach) {
  shapes_.push_back(shape);
  enter(shape, reach, static_cast<std::int32_t>(shapes_.size() - 1));
}

/// Enters the index in the cells near the shape. A long shape is halved first: if it is turned, most cells of
/// its bounding box are far away from it.
void ShapeGrid::enter(const Rectangle& shape, double reach, std::int32_t index) {
  constexpr double long_shape = 4.0;  // [-] times its width, or times a cell
  if (shape.half.x() > long_shape * std::max(cell_, shape.half.y() + reach)) {
    const Eigen::Vector2d half(0.5 * shape.half.x(), shape.half.y());
    enter({shape.centre - half.x() * shape.axis, shape.axis, half}, reach, index);
    enter({shape.centre + half.x() * shape.axis, shape.axis, half}, reach, index);
    return;
  }
  const Eigen::Vector2d other_axis(-shape.axis.y(), shape.axis.x());
  const Eigen::Vector2d extent =
      (shape.axis.cwiseAbs() * shape.half.x() + other_axis.cwiseAbs() * shape.half.y()).array() + reach;
  const Eigen::Array2i first = cell_of(shape.centre - extent);
  const Eigen::Array2i last = cell_of(shape.centre + extent);
  const double half_diagonal = cell_ / std::numbers::sqrt2;
  for (int row = first.y(); row <= last.y(); ++row) {
    for (int column = first.x(); column <= last.x(); ++column) {
      const Eigen::Vector2d middle =
          cell_ * (Eigen::Vector2d(column, row).array() + 0.5).matrix() - 0.5 * ground_size_;
      if (distance(middle, shape) <= reach + half_diagonal)
        by_cell_[index_of({column, row})].push_back(index);
    }
  }
}

/// The cell in which a point lies; for a point outside the ground, the nearest cell.
Eigen::Array2i ShapeGrid::cell_of(const Eigen::Vector2d& p) const {
  const Eigen::Array2d position = ((p + 0.5 * ground_size_) / cell_).array().floor();
  const Eigen::Array2d last = (cells_ - 1).cast<double>();
  return position.max(0.0).min(last).cast<int>();
}

}  // namespace worlds
