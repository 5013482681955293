// The records of the condensation tree: one for each landmark, one for each node.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "seif/freezing.hpp"
#include "seif/tree/front.hpp"
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
  int row = 0;                         // in the part that is being looked at
  Point home = Point::Zero();          // where it joined: its place in the tree, whatever closes later [m]
  Point mean = Point::Zero();          // if it is cold: as that node last heard of it [m]
  mutable Point read = Point::Zero();  // what that is by now, if somebody has looked [m]
  Point place = Point::Zero();         // where the latest plan has it [m]
};

/// All landmarks below a node, where they move as one rigid body.
struct LandmarkGroup {
  using Motion = Eigen::Matrix<double, 3, 1, Eigen::DontAlign>;
  static constexpr int none = -1;

  CondensedLandmark::Point place = CondensedLandmark::Point::Zero();  // of its middle, as for a landmark [m]
  double place_turn = 0.0;                                            // [rad] its turn then
  CondensedLandmark::Point start = CondensedLandmark::Point::Zero();  // p_world of it when it began [m]
  int settled_at = none;
  Motion mean = Motion::Zero();          // all its motion so far [m, m, rad], as above
  mutable Motion read = Motion::Zero();  // as above
  int fronts = 0;                        // [-] that it is in
  int known_in = 0;                      // number of the plan in which `read` is known, or begun
  int present_in = 0;                    // number of the front that it was last found in
  int wanted_by = 0;                     // number of the count of variables that would be tied to it
  int members = 0;                       // [-] these
};

/// The message of a node towards the hub; the hub's own goes to the zone. A bare node passes on the messages that
/// it gets; a bare cold leaf sends its blocks of Omega unchanged.
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

  SentMessage sent;                  // nothing while it is the hub: see CondensationTree::sent()
  int stale_in = 0;                  // number of the plan that has it send anew
  int planned = none;                // index among the messages of that plan
  mutable std::int64_t read_at = 0;  // epoch
  LandmarkGroup group;
  double distance_ratio = 0.0;  // [-] its distance from the next hot leaves over its size
  int distance_known_in = 0;    // number of the plan that knows it

  // For leaves.
  Condensed own;              // its element (leaf_element.hpp); with most_blocks, without plan_.fresh
  int first_landmark = none;  // slot
  int landmarks = 0;          // [-]
  bool hot = false;
  bool next_hot = false;  // in the next zone, if one is planned; otherwise as `hot`
  bool wanted = false;
  int used = 0;  // scan that last had a landmark of it in the window
};

/// Pieces that keep their memory, so that no update allocates.
class FrozenPieces {
 public:
  void add(const FrozenPiece& piece) {
    if (count_ == pieces_.size()) pieces_.emplace_back();
    pieces_[count_++] = piece;
  }
  void clear() { count_ = 0; }
  std::span<const FrozenPiece> all() const { return std::span(pieces_).first(count_); }

 private:
  std::vector<FrozenPiece> pieces_;
  std::size_t count_ = 0;
};

/// The next zone, and the messages that it needs, while they are prepared.
struct CondensationPlan {
  bool is_running = false;
  int number = 0;                    // of all plans so far
  std::vector<int> hot_leaves;       // of the next zone
  std::vector<int> stale;            // nodes that send anew
  std::vector<int> order;            // the same, each after those that it depends on
  std::int64_t most_blocks = 0;      // [-] that one update makes ready; 0: all
  std::size_t ready = 0;             // [-] of these
  std::int64_t worked = 0;           // [-] blocks, in this update
  bool has_told = false;             // whether its messages hold the residuals from where the means are
  std::vector<int> begun;            // nodes whose groups are
  FrozenPieces fresh;                // frozen since, and not yet in the elements of their leaves
  std::deque<SentMessage> messages;  // by that order, as far as ready
  std::vector<int> new_leaves;       // that have come since, and stand beside the tree
};

}  // namespace seif
