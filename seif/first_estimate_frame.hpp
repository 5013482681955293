// The pose in the frame of the landmarks' first estimates, which stay where they are when a correction moves
// the map.
#pragma once

#include <Eigen/Core>
#include <span>

#include "seif/types.hpp"

namespace seif {

/// A landmark's mean and its first estimate; both are p_world_landmark [m].
struct FirstEstimate {
  Eigen::Vector2d mean;
  Eigen::Vector2d first;
};

/// A lever is the vector from the pose to a landmark. Whether the lever between first estimates can replace the
/// lever between means [m]: not if they differ by more than the noise of a sighting explains, `sighting_sd`
/// [m]. Then the landmark was moved with another part of the map. The bound was chosen on rings of 500 m, where
/// bounds of five to ten made no difference.
inline bool are_levers_alike(const Eigen::Vector2d& first_lever, const Eigen::Vector2d& lever,
                             double sighting_sd) {
  constexpr double most_sigmas = 7.0;  // [sigma]
  return (first_lever - lever).squaredNorm() <= most_sigmas * most_sigmas * sighting_sd * sighting_sd;
}

struct FramedPose {
  Pose2 pose;                  // T_world_robot in a frame of first estimates
  bool another_frame = false;  // a different frame from the one of `carried`
};

/// Applies to `pose` the rigid motion that brings the means of landmarks closest to their first estimates.
/// `carried` is the pose's old place in the frame of the first estimates, moved on by odometry. Normally the
/// landmarks that count are those whose first estimates are near where they should be for a robot at `carried`.
/// At the seam of a closed loop there are two kinds of landmarks, since the closure has moved the end of the
/// loop onto its beginning. The other kind counts as soon as more than half of the landmarks do not fit to
/// `carried` and they agree with one another. Reorders `landmarks`.
FramedPose pose_among(std::span<FirstEstimate> landmarks, const Pose2& pose, const Pose2& carried,
                      double sighting_sd);

}  // namespace seif
