// Where the pose stands among the first estimates of landmarks, whatever the map has moved by since.
#pragma once

#include <Eigen/Core>
#include <span>

#include "seif/types.hpp"

namespace seif {

/// A landmark where it is believed to be, and where it was first; p_world_landmark [m].
struct FirstEstimate {
  Eigen::Vector2d mean;
  Eigen::Vector2d first;
};

/// Whether a lever between first estimates may stand for the one between means. If it is too wrong, a step of
/// the heading no longer moves the landmark by what it should, and an observation says what is not true. The
/// fraction was chosen on rings of 500 m and 2 km, on which 0.1 to 0.35 made no difference.
inline bool stands_for(const Eigen::Vector2d& first_lever, const Eigen::Vector2d& lever) {
  constexpr double most = 0.3;  // [-] of its length
  return (first_lever - lever).squaredNorm() <= most * most * lever.squaredNorm();
}

struct FramedPose {
  Pose2 pose;                  // T_world_robot among the first estimates
  bool another_frame = false;  // not the one that the pose came from
};

/// Turns and moves `pose` by the rigid motion that brings landmarks closest to their first estimates: those
/// near where they stand if the pose is at `carried`, its old place among them carried along by odometry. At
/// the end of a loop there are two kinds, the loop having been closed by moving its end onto its beginning:
/// once more than half are not where `carried` has them, and agree with one another, they are the ones that
/// count. Reorders `landmarks`.
FramedPose pose_among(std::span<FirstEstimate> landmarks, const Pose2& pose, const Pose2& carried);

}  // namespace seif
