// The records of the condensation tree: one for each landmark, one for each node.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "seif/tree/condensed.hpp"
#include "seif/tree/leaf_tree.hpp"

namespace seif {

/// A landmark in the tree.
struct CondensedLandmark {
  using Point = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
  static constexpr int none = -1;

  int leaf = none;
  int next = none;        // slot of the next landmark of the leaf
  int leaves = 0;         // [-] that mention it
  int zone_index = none;  // in the zone, or none
  int settled_at = none;  // if it is cold: the node where it is eliminated, or tied to a group
  int visit = 0;
  int row = 0;                            // in the part that is being looked at
  Point home = Point::Zero();             // where it joined: its place in the tree, whatever closes later [m]
  Point mean = Point::Zero();             // if it is cold: as that node last heard of it [m]
  mutable Point read = Point::Zero();     // what that is by now, if somebody has looked [m]
  mutable Point planned = Point::Zero();  // what it was when the latest plan began [m]
};

/// All landmarks below a node, where they move as one body.
struct LandmarkGroup {
  static constexpr int none = -1;

  CondensedLandmark::Point start =
      CondensedLandmark::Point::Zero();  // p_world of its middle when it began [m]
  int settled_at = none;
  GroupMotion mean = GroupMotion::Zero();             // all its motion so far, as above
  mutable GroupMotion read = GroupMotion::Zero();     // as above
  mutable GroupMotion planned = GroupMotion::Zero();  // as above
  int fronts = 0;                                     // [-] that it is in
  int known_in = 0;    // number of the plan in which `planned` is known, or begun
  int present_in = 0;  // number of the front that it was last found in
  int wanted_by = 0;   // number of the count of variables that would be tied to it
  int unknowns = 0;    // [-] of these
};

/// The message of a node or a ring. A bare one passes on the messages that it gets; a cold leaf sends its element
/// unchanged.
struct SentMessage {
  Condensed message;
  bool is_bare = true;
  std::vector<int> groups;  // nodes whose groups are in its front
  LeafTree::Box reach;  // a hot leaf may not come in here without a look at these groups, and those behind

  void take(SentMessage& other) {
    message.take(other.message);
    is_bare = other.is_bare;
    groups = other.groups;
    reach = other.reach;
  }
};

/// A node of the tree. An epoch ends with anything that changes a mean, or where it is stored.
struct CondensationNode {
  static constexpr int none = -1;

  SentMessage sent;                  // nothing while a leaf below it is hot
  int stale_in = 0;                  // number of the plan that has it send anew
  int planned = none;                // index among the messages of that plan
  mutable std::int64_t read_at = 0;  // epoch
  LandmarkGroup group;
  double distance_ratio = 0.0;  // [-] its distance from the next hot leaves over its size
  int distance_known_in = 0;    // number of the plan that knows it

  bool on_path = false;         // a leaf below it, or it, is hot
  bool next_on_path = false;    // the same for the zone that is planned
  int ring = 0, next_ring = 0;  // that it belongs to, if it is on the path

  // For leaves.
  Condensed own;              // its element (leaf_element.hpp); without what was frozen since the plan began
  int first_landmark = none;  // slot
  int landmarks = 0;          // [-]
  bool hot = false;
  bool next_hot = false;  // in the next zone, if one is planned; otherwise as `hot`
  bool wanted = false;
  int used = 0;  // scan that last had a landmark of it in the window
};

}  // namespace seif
