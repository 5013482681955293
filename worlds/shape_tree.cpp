#include "worlds/shape_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace worlds {
namespace {

/// The rectangle along the axes of the world with these corners.
Rectangle box_between(const Eigen::Vector2d& min, const Eigen::Vector2d& max) {
  return {0.5 * (min + max), Eigen::Vector2d::UnitX(), 0.5 * (max - min)};
}

}  // namespace

ShapeTree::ShapeTree(std::vector<Rectangle> shapes, const std::vector<double>& reaches)
    : shapes_(std::move(shapes)) {
  add_parts(reaches);
  if (!parts_.empty()) build(0, parts_.size());
}

/// Cuts long shapes lengthwise into shorter parts. There are at most five times as many parts as shapes.
void ShapeTree::add_parts(const std::vector<double>& reaches) {
  const double more = 4.0 * static_cast<double>(shapes_.size());  // [-] parts, of all shapes together
  double sum = 0.0;                                               // [m]
  for (const Rectangle& shape : shapes_) sum += shape.half.x();
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    const Rectangle& shape = shapes_[i];
    const double count = sum > 0 ? 1 + std::floor(more * (shape.half.x() / sum)) : 1;
    const double half = shape.half.x() / count;
    const Eigen::Vector2d other_axis(-shape.axis.y(), shape.axis.x());
    const Eigen::Vector2d extent = shape.axis.cwiseAbs() * half + other_axis.cwiseAbs() * shape.half.y();
    for (double k = 0; k < count; ++k) {
      const Eigen::Vector2d centre = shape.centre + ((2 * k + 1) * half - shape.half.x()) * shape.axis;
      const double reach = reaches.empty() ? 0.0 : reaches.at(i);
      parts_.push_back({centre - extent, centre + extent, reach, static_cast<std::int32_t>(i)});
    }
  }
}

/// Adds a node for these parts, and those below it. The parts are halved along the longer side of their box.
void ShapeTree::build(std::size_t begin, std::size_t end) {
  constexpr std::size_t most_in_leaf = 4;  // [-]
  Eigen::Vector2d min = parts_[begin].min;
  Eigen::Vector2d max = parts_[begin].max;
  double reach = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    reach = std::max(reach, parts_[i].reach);
    min = min.cwiseMin(parts_[i].min);
    max = max.cwiseMax(parts_[i].max);
  }
  const std::size_t index = nodes_.size();
  nodes_.push_back({box_between(min, max), reach, 0, 0, 0});
  if (end - begin <= most_in_leaf) {
    nodes_[index].begin = static_cast<std::int32_t>(begin);
    nodes_[index].end = static_cast<std::int32_t>(end);
    return;
  }
  const Eigen::Index side = max.x() - min.x() > max.y() - min.y() ? 0 : 1;
  const auto place = [side](const Part& part) { return part.min[side] + part.max[side]; };
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return parts_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](const Part& a, const Part& b) { return place(a) < place(b); });
  build(begin, middle);
  nodes_[index].second = static_cast<std::int32_t>(nodes_.size());
  build(middle, end);
}

}  // namespace worlds
