// Rectangles in a tree of boxes. Finding those near a place takes work that grows with the logarithm of their
// number, however unevenly they lie: a path of a hundred thousand short legs is one case, a few long walls
// across the ground are another.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "worlds/geometry.hpp"

namespace worlds {

class ShapeTree {
 public:
  /// Shapes are numbered from 0 in this order. `reaches` [m]: how far each of them is felt; empty: not at all.
  explicit ShapeTree(std::vector<Rectangle> shapes, const std::vector<double>& reaches = {});

  /// Whether any(index, shape) is true for a shape that is felt within `reach` [m] of a point or segment. `any` is
  /// also called for some shapes farther away, and may be called several times for one shape.
  template <class Place, class Predicate>
  bool any_near(const Place& place, double reach, const Predicate& any) const {
    return !nodes_.empty() && any_in(0, place, reach + rounding, any);
  }

 private:
  static constexpr double rounding = 1e-6;  // [m] far more than that of any distance on the largest ground

  /// A part of a shape, so that a long shape that is turned does not need a large box.
  struct Part {
    Eigen::Vector2d min = Eigen::Vector2d::Zero();  // [m] of its box
    Eigen::Vector2d max = Eigen::Vector2d::Zero();  // [m]
    double reach = 0.0;                             // [m]
    std::int32_t shape = 0;
  };

  /// An inner node is followed by its first child; a leaf holds parts.
  struct Node {
    Rectangle box;
    double reach = 0.0;       // [m] the largest of its parts
    std::int32_t begin = 0;   // of the parts of a leaf
    std::int32_t end = 0;     // equal to begin: this is no leaf
    std::int32_t second = 0;  // index of the second child
  };

  void add_parts(const std::vector<double>& reaches);
  void build(std::size_t begin, std::size_t end);

  template <class Place, class Predicate>
  bool any_in(std::size_t index, const Place& place, double reach, const Predicate& any) const {
    const Node& node = nodes_[index];
    if (distance(place, node.box) > reach + node.reach) return false;
    for (std::int32_t i = node.begin; i < node.end; ++i) {
      const auto shape = static_cast<std::size_t>(parts_[static_cast<std::size_t>(i)].shape);
      if (any(shape, shapes_[shape])) return true;
    }
    return node.begin == node.end && (any_in(index + 1, place, reach, any) ||
                                      any_in(static_cast<std::size_t>(node.second), place, reach, any));
  }

  std::vector<Rectangle> shapes_;
  std::vector<Part> parts_;
  std::vector<Node> nodes_;
};

}  // namespace worlds
