// What the condensation tree keeps of each landmark and of each node.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "seif/front.hpp"

namespace seif {

/// A landmark in the tree.
struct CondensedLandmark {
  using Point = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
  static constexpr int none = -1;

  int leaf = none;
  int next = none;           // slot of the next landmark of the leaf
  int leaves = 0;            // [-] that mention it, if it is cold
  int hot = none;            // its place in the zone
  int eliminated_at = none;  // node, if it is cold
  int visit = 0;
  Point mean = Point::Zero();          // if it is cold: as its elimination last heard of it [m]
  mutable Point read = Point::Zero();  // what that is by now, if somebody has looked [m]
};

/// A node of the tree; an epoch ends with whatever changes a mean, or how it is held.
struct CondensationNode {
  static constexpr int none = -1;

  Condensed message;             // towards the hub; the hub's: to the zone
  bool is_stale = true;          // the message
  std::int64_t followed_at = 0;  // epoch in which those eliminated here were last written down
  mutable std::int64_t read_at = 0;

  // Of leaves.
  int first_landmark = none;  // slot
  int landmarks = 0;          // [-]
  bool hot = false;
  bool wanted = false;  // in the next zone
  int used = 0;         // scan that last had a landmark of it in the window
};

}  // namespace seif
