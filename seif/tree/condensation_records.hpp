// What the objects of the condensation tree share: the tree, its nodes and their messages, and the landmarks.
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
  static constexpr int most_bare = 8;  // [-] leaves below a node that condenses nothing
  using Node = CondensationNode;

  CondensationRecords(const CondensationOptions& options_, const Pose2& start) : options(options_), tree(start) {}

  CondensationOptions options;
  LeafTree tree;
  ChunkedArray<Node> nodes;
  ChunkedArray<CondensedLandmark> landmarks;  // by slot
  SentMessage to_zone;                        // by the hub
  std::vector<int> hot_leaves;
  int held_leaf = none;  // beside the tree; always hot
  double view = 0.0;     // how far the robot sees [m]

  CondensedLandmark& landmark(int slot) { return landmarks[static_cast<std::size_t>(slot)]; }
  const CondensedLandmark& landmark(int slot) const { return landmarks[static_cast<std::size_t>(slot)]; }
  Node& node(int i) { return nodes[static_cast<std::size_t>(i)]; }
  const Node& node(int i) const { return nodes[static_cast<std::size_t>(i)]; }
  SentMessage& sent(int at) { return at == tree.hub() ? to_zone : node(at).sent; }
  const SentMessage& sent(int at) const { return at == tree.hub() ? to_zone : node(at).sent; }
  int node_of(FrontVariable v) const { return is_group(v) ? ~v : landmark(v).leaf; }
  int settled_at(FrontVariable v) const { return is_group(v) ? node(~v).group.settled_at : landmark(v).settled_at; }
  template <class Visit>
  void for_each_landmark(int leaf, Visit&& visit) const {
    for (int slot = node(leaf).first_landmark; slot != none; slot = landmark(slot).next) visit(slot);
  }

  /// Two landmarks that are seen at the same time are nearer to each other than `near`.
  Turning turning() const { return {.allowed = options.turns, .near = 2.0 * view}; }

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
