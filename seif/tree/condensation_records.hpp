// What the objects of the condensation tree share: the tree, its nodes and their messages, and the landmarks.
//
// Nodes above a hot leaf are the path. A node that is not on the path sends up, once. What comes to the path is
// collected in rings around the zone, one for each size of path nodes: a ring condenses what comes from the next outer
// ring and from the cold children of its path nodes, and sends to the next inner one. Ring 0 is the zone.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "seif/chunked_array.hpp"
#include "seif/tree/condensation_nodes.hpp"
#include "seif/tree/condensation_options.hpp"
#include "seif/tree/leaf_tree.hpp"
#include "seif/tree/moved_boundary.hpp"

namespace seif {

/// Of a cold variable: the mean that was read last, or that when the latest plan began.
enum class Means { read, planned };

struct CondensationRecords {
  static constexpr int none = -1;
  static constexpr int most_bare = 8;   // [-] leaves below a node that condenses nothing
  static constexpr int ring_ratio = 2;  // [-] of the sizes of path nodes of two rings
  using Node = CondensationNode;

  CondensationRecords(const CondensationOptions& options_, const Pose2& start);

  CondensationOptions options;
  LeafTree tree;
  ChunkedArray<Node> nodes;
  ChunkedArray<CondensedLandmark> landmarks;  // by slot
  std::vector<int> hot_leaves;
  std::vector<int> path;  // hot leaves in the tree, and all nodes above them
  int top_ring = 0;       // the outermost one
  int held_leaf = none;   // beside the tree; always hot
  double view = 0.0;      // how far the robot sees [m]

  CondensedLandmark& landmark(int slot) { return landmarks[static_cast<std::size_t>(slot)]; }
  const CondensedLandmark& landmark(int slot) const { return landmarks[static_cast<std::size_t>(slot)]; }
  Node& node(int i) { return nodes[static_cast<std::size_t>(i)]; }
  const Node& node(int i) const { return nodes[static_cast<std::size_t>(i)]; }
  SentMessage& sent(int at) { return node(at).sent; }
  const SentMessage& sent(int at) const { return node(at).sent; }
  int node_of(FrontVariable v) const { return is_group(v) ? ~v : landmark(v).leaf; }
  int settled_at(FrontVariable v) const {
    return is_group(v) ? node(~v).group.settled_at : landmark(v).settled_at;
  }
  template <class Visit>
  void for_each_landmark(int leaf, Visit&& visit) const {
    for (int slot = node(leaf).first_landmark; slot != none; slot = landmark(slot).next) visit(slot);
  }

  /// Two landmarks that are seen at the same time are nearer to each other than `near`.
  Turning turning() const { return {.allowed = options.turns, .near = 2.0 * view}; }

  // Rings have the first nodes, beside the tree. Ring 0 is the zone.
  static constexpr int most_rings = 32;
  static bool is_ring(int at) { return at < most_rings; }
  /// The ring of a path node with so many leaves: one for each size.
  static int ring_of(int leaves);
  /// Where a message goes: to the node above, or to a ring. none for ring 0.
  int receiver(int at) const;
  /// What sends to a node or a ring.
  template <class Visit>
  void for_each_source(int at, Visit&& visit) const {
    if (!is_ring(at)) {
      for (const int child : tree.children(at)) {
        if (child != none) visit(child);
      }
      return;
    }
    if (at < top_ring) visit(at + 1);
    for (const int n : path) {
      if (node(n).ring != at) continue;
      for (const int child : tree.children(n)) {
        if (child != none && !node(child).on_path) visit(child);
      }
    }
  }

  /// (freedom(v))
  void read_mean(FrontVariable v, Means means, double* to) const;
  /// Where a variable with this mean is: a landmark, or the middle of a group. [m]
  Eigen::Vector2d place(FrontVariable v, const double* mean) const;
  MovedPlace moved_place(FrontVariable v, const double* reference, const double* mean) const;
  /// Where the variables of a part were, and are by these means.
  void list_places(const Condensed& part, Means means, std::vector<MovedPlace>& places) const;

  std::size_t memory_bytes() const;
};

}  // namespace seif
