// Fits what lies around the robot to landmarks of the map, with the filter's own covariance.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "seif/association/local_belief.hpp"
#include "seif/relocating/surroundings.hpp"

namespace seif {

/// Something around the robot, and the landmark of the map that it is taken for.
struct Pairing {
  std::size_t around = 0;  // its number in the surroundings
  LandmarkId landmark = no_landmark;
};

/// Where the surroundings lie best, if these pairs are right.
struct Placement {
  Pose2 T_world_robot;
  std::vector<Pairing> pairs;
  double squared_distance = 0.0;  // [-] v' S^-1 v there, with 2 pairs - 3 degrees of freedom
  std::size_t worst = 0;          // the pair that fits least
  /// [nat] log sqrt(det S det(J_x' S^-1 J_x)): of all places that 2 pairs coordinates could have, what a pose of 1 m^2 and
  /// 1 rad covers for each unit of the residuals' space.
  double log_density_of_poses = 0.0;
};

/// Landmarks at hand, in the frame of the robot as the filter believes it: T_world_robot.
Surroundings surroundings_of(const LocalBelief& belief, const Pose2& T_world_robot,
                             std::vector<LandmarkId> ids);

/// From two points in the frame of the robot, and where they are in the world.
Pose2 pose_from(const Eigen::Vector2d& a_robot, const Eigen::Vector2d& b_robot,
                const Eigen::Vector2d& a_world, const Eigen::Vector2d& b_world);

/// Gauss and Newton's least squares for the pose, of which nothing else is known, from `placement.T_world_robot` on. v
/// has the covariance S of map and surroundings together. The landmarks are at hand. False if S is not positive definite,
/// or for fewer than two pairs.
[[nodiscard]] bool fit(const LocalBelief& belief, const Surroundings& surroundings, Placement& placement);

/// Fits, and leaves out the pair that fits least until the rest agree. False, with fewer than `fewest` pairs left, if
/// they never do.
[[nodiscard]] bool fit_most(const LocalBelief& belief, const Surroundings& surroundings, std::size_t fewest,
                            Placement& placement);

/// What the filter is told: the pose is kept if the surroundings agree with it, T_world_robot as the filter believes it.
/// `names` and `is_used`: of each of the surroundings.
Relocation relocation_to(const LocalBelief& belief, const Pose2& T_world_robot,
                         const Surroundings& surroundings, const Placement& placement,
                         const std::vector<LandmarkId>& names, const std::vector<bool>& is_used);

/// v' S^-1 v if the pose is what the filter believes, with 2 pairs degrees of freedom.
double squared_distance_from_belief(const LocalBelief& belief, const Pose2& T_world_robot,
                                    const Surroundings& surroundings, const std::vector<Pairing>& pairs);

}  // namespace seif
