// A rigid group of landmarks, or of smaller groups, in the hierarchy of MultilevelMean.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace seif {

struct RigidGroup {
  struct Link {
    int other;          // a group of the same level
    Eigen::Matrix3d A;  // (3 x 3) rows: this group; columns: the other
  };
  int level = 1;
  int parent = -1;
  int members = 0;                                   // [-] landmarks or groups
  int first_member = -1;                             // slot; level 1 only
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // p_world [m], of the first mean of the first member
  Eigen::Vector3d d = Eigen::Vector3d::Zero();       // all its own motion so far [m, m, rad]
  Eigen::Vector3d S = Eigen::Vector3d::Zero();       // R = S - A total, the sum over itself and its links
  Eigen::Vector3d q = Eigen::Vector3d::Zero();       // forces not yet in S, nor passed on to the parent
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();       // (3 x 3) its own information
  std::vector<Link> links;
  double residual = 0.0;  // [-] R' A^-1 R when last touched
  int visit = 0;          // mark of the last walk that came by
  bool has_forces = false;
  // The motion of the group with those above it, and the count of motions at which it was computed.
  Eigen::Vector3d cached_total = Eigen::Vector3d::Zero();
  std::int64_t cached_at = -1;
};

/// A landmark in its group of level 1.
struct GroupMember {
  int group = -1;
  int next = -1;                                     // slot of the next landmark of the group
  Eigen::Vector2d lever = Eigen::Vector2d::Zero();   // from the centre of its group [m]
  Eigen::Vector2d stored = Eigen::Vector2d::Zero();  // the part of its groups' motion in its stored mean [m]
};

}  // namespace seif
