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

/// Whether a lever between first estimates can be used for the one between means [m]: not if the two differ by
/// more than the noise of a sighting explains, `sighting_sd` [m]. Then the landmark was moved with another part
/// of the map. The bound was chosen on rings of 500 m, where bounds of five to ten made no difference.
inline bool are_levers_alike(const Eigen::Vector2d& first_lever, const Eigen::Vector2d& lever,
                             double sighting_sd) {
  constexpr double most_sigmas = 7.0;  // [sigma]
  return (first_lever - lever).squaredNorm() <= most_sigmas * most_sigmas * sighting_sd * sighting_sd;
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
FramedPose pose_among(std::span<FirstEstimate> landmarks, const Pose2& pose, const Pose2& carried,
                      double sighting_sd);

}  // namespace seif
