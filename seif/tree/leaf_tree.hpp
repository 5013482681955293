// A binary tree of places: its leaves stand where their keys put them, and every node knows the way to one
// node of them all, the hub.
//
//            tree             plane
//             o              +-------+---+---+
//          /     \           |       | 2 | 3 |
//         o       o          |   0   +---+---+
//        / \     / \         |       |   1   |
//       0   1   2   3        +-------+-------+
//
// A key holds the bits of a place's two coordinates in turns, the highest first. Each bit halves a rectangle
// of the plane, and an inner node stands for the rectangle of its leaves. So places that are near to each
// other mostly are so in the tree, in whatever order they come, and nothing has to be balanced.
//
// A leaf that lies in the other half of a rectangle than the last one begins a new branch there, above all
// older ones, some times: so what a robot comes by in one go stays together as well, and in an area that it
// sweeps fewer landmarks lie on the border of a branch than on that of a rectangle.
//
//   towards(n): the neighbour of n, parent or child, on its way to the hub.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "seif/chunked_array.hpp"
#include "seif/types.hpp"

namespace seif {

class LeafTree {
 public:
  static constexpr int none = -1;

  /// The grid lies where the robot starts, so that nothing depends on where the world has its origin.
  explicit LeafTree(const Pose2& start);

  /// A leaf that does not stand in the tree yet, and has no box; returns its node.
  int new_leaf();
  /// Puts a new leaf where the middle of its box belongs. The first one is the hub. An inner node may be
  /// added too, between the leaf and all others. Not between plan_hub() and move_hub().
  void attach(int leaf);

  int size() const { return static_cast<int>(nodes_.size()); }
  bool is_leaf(int node) const { return at(node).child[0] == none; }
  /// How many leaves stand below it, or 1 if it is one. [-]
  int leaves(int node) const { return at(node).leaves; }
  /// none for the root.
  int parent(int node) const { return at(node).parent; }
  /// Whether `node` is `ancestor`, or stands below it.
  bool is_within(int node, int ancestor) const;

  using Box = Eigen::AlignedBox2d;
  /// Of an inner node: the rectangle that it stands for, whatever leaves are yet to come. Of a leaf: what it
  /// has been widened to. In the grid's frame. [m]
  const Box& box(int node) const { return at(node).box; }
  /// Of its box, in the world. [m]
  Eigen::Vector2d centre(int node) const;
  void widen(int leaf, const Eigen::Vector2d& p_world);

  int hub() const { return hub_; }
  /// none for the hub.
  int towards(int node) const { return at(node).towards; }
  /// The same once the hub is where it is planned to be.
  int planned_towards(int node) const { return at(node).planned_towards; }

  template <class Visit>
  void for_each_neighbour(int node, Visit&& visit) const {
    const Node& n = at(node);
    for (const int neighbour : {n.child[0], n.child[1], n.parent}) {
      if (neighbour != none) visit(neighbour);
    }
  }

  /// Visits the neighbours of a node but that on the way to the hub.
  template <class Visit>
  void for_each_source(int node, Visit&& visit) const {
    for_each_neighbour(node, [&](int other) {
      if (other != towards(node)) visit(other);
    });
  }
  template <class Visit>
  void for_each_planned_source(int node, Visit&& visit) const {
    for_each_neighbour(node, [&](int other) {
      if (other != planned_towards(node)) visit(other);
    });
  }

  /// Visits the leaves whose boxes come nearer to p_world than `distance` [m].
  template <class Visit>
  void for_each_leaf_near(const Eigen::Vector2d& p_world, double distance, Visit&& visit) {
    if (root_ == none) return;
    const Eigen::Vector2d p = in_grid(p_world);
    near_.assign(1, root_);
    while (!near_.empty()) {
      const int node = near_.back();
      near_.pop_back();
      if (box(node).squaredExteriorDistance(p) > distance * distance) continue;
      if (is_leaf(node)) {
        visit(node);
      } else {
        near_.insert(near_.end(), {at(node).child[1], at(node).child[0]});
      }
    }
  }

  /// The lowest node above all of these; at least one.
  int common_ancestor(std::span<const int> leaves);

  /// Which node is to become the hub, and then makes it so.
  void plan_hub(int to);
  void move_hub();

  std::size_t memory_bytes() const { return nodes_.memory_bytes(); }

 private:
  struct Node {
    int parent = none;
    int child[2] = {none, none};
    int towards = none, planned_towards = none;
    Box box;
    std::uint64_t key = 0;  // of one of its leaves
    int bit = none;         // the highest in which its leaves differ
    int leaves = 0;         // [-] below it
    int branches = 0;       // [-] begun in its rectangle, so far down
    int marks = 0;          // of the leaves that common_ancestor() has gone up from
    int mark = 0;           // of which of its calls
  };

  Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }
  const Node& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  Eigen::Vector2d in_grid(const Eigen::Vector2d& p_world) const;
  int add_node();
  int insert_above(int below);

  Pose2 T_world_grid_;
  ChunkedArray<Node> nodes_;
  int root_ = none;
  int hub_ = none;
  int mark_ = 0;
  std::vector<int> way_;   // nodes that lead elsewhere once the hub is where it is planned to be
  std::vector<int> near_;  // nodes yet to be looked at
};

}  // namespace seif
