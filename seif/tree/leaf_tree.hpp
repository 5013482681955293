// A binary tree over the plane. Keys decide where its leaves are.
//
//            tree             plane
//             o              +-------+---+---+
//          /     \           |       | 2 | 3 |
//         o       o          |   0   +---+---+
//        / \     / \         |       |   1   |
//       0   1   2   3        +-------+-------+
//
// A key interleaves the bits of a point's two coordinates, the highest first. Each bit halves a rectangle of the
// plane, and an inner node represents the rectangle of its leaves. So points that are near each other are mostly
// near in the tree, in whatever order they come, and nothing must be balanced.
//
// A leaf in another half of a rectangle than the last leaf may begin a new branch there, above all older ones. So
// landmarks that a robot passes in one drive stay together. In an area that it sweeps, fewer landmarks then lie on
// the border of a branch than on that of a rectangle.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "seif/chunked_array.hpp"
#include "seif/types.hpp"

namespace seif {

class LeafTree {
 public:
  static constexpr int none = -1;

  /// The grid's origin is the robot's start, so that nothing depends on the origin of the world.
  explicit LeafTree(const Pose2& start);

  /// Makes a leaf that is not in the tree yet and has no box; returns its node.
  int new_leaf();
  /// Inserts a new leaf by the middle of its box. Returns the inner node that this adds between the leaf and all
  /// others, or none.
  int attach(int leaf);

  int size() const { return static_cast<int>(nodes_.size()); }
  bool is_leaf(int node) const { return at(node).child[0] == none; }
  /// The number of leaves below it; 1 for a leaf. [-]
  int leaves(int node) const { return at(node).leaves; }
  /// none for the root.
  int parent(int node) const { return at(node).parent; }
  /// Whether `node` is `ancestor` or below it.
  bool is_within(int node, int ancestor) const;

  using Box = Eigen::AlignedBox2d;
  /// For an inner node: the rectangle that it represents. For a leaf: the box that it was widened to. In the grid's
  /// frame. [m]
  const Box& box(int node) const { return at(node).box; }
  /// What all boxes of the leaves below it lie in. A box may reach out of the rectangles above it. [m]
  const Box& cover(int node) const { return is_leaf(node) ? at(node).box : at(node).cover; }
  /// The middle of its box, in the world. [m]
  Eigen::Vector2d centre(int node) const;
  void widen(int leaf, const Eigen::Vector2d& p_world);

  /// none for a leaf.
  std::array<int, 2> children(int node) const { return {at(node).child[0], at(node).child[1]}; }

  /// Visits the leaves whose boxes come nearer to p_world than `distance` [m].
  template <class Visit>
  void for_each_leaf_near(const Eigen::Vector2d& p_world, double distance, Visit&& visit) {
    if (root_ == none) return;
    const Eigen::Vector2d p = in_grid(p_world);
    near_.assign(1, root_);
    while (!near_.empty()) {
      const int node = near_.back();
      near_.pop_back();
      if (cover(node).squaredExteriorDistance(p) > distance * distance) continue;
      if (is_leaf(node)) {
        visit(node);
      } else {
        near_.insert(near_.end(), {at(node).child[1], at(node).child[0]});
      }
    }
  }

  std::size_t memory_bytes() const { return nodes_.memory_bytes(); }

 private:
  struct Node {
    int parent = none;
    int child[2] = {none, none};
    Box box;
    Box cover;              // of an inner node
    std::uint64_t key = 0;  // of one of its leaves
    int bit = none;         // the highest in which its leaves differ
    int leaves = 0;         // [-] below it
    int branches = 0;       // [-] begun in its rectangle, so far down
  };

  Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }
  const Node& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  Eigen::Vector2d in_grid(const Eigen::Vector2d& p_world) const;
  int add_node();
  int insert_above(int below);
  void cover_above(int node, const Box& box);

  Pose2 T_world_grid_;
  ChunkedArray<Node> nodes_;
  int root_ = none;
  std::vector<int> near_;  // nodes yet to be looked at
};

}  // namespace seif
