// The frame of the start. Robot and map turn and move with the start as one, and no observation tells how
// far. So a filter can estimate as if it knew its start, and add the uncertainty of the start to the
// covariances that it returns. A linear filter that holds this uncertainty itself may turn its whole map. It
// turns along a straight line, not along a circle, so a turn by epsilon enlarges the map by epsilon^2 / 2.
#pragma once

#include <Eigen/Core>

#include "seif/types.hpp"

namespace seif {

/// Splits the covariance Sigma of a start into an inner part, which the filter starts with, and an outer part:
///   inner = (Sigma^-1 + D^-2)^-1,  outer = Sigma - inner = Sigma (Sigma + D^2)^-1 Sigma.
/// D is a millimetre and a milliradian: nothing for a map, and not so little that rounding would matter. Both
/// parts are positive semidefinite for every Sigma.
class StartFrame {
 public:
  /// Throws std::invalid_argument if the covariance of the start is not positive definite.
  explicit StartFrame(const PoseEstimate& start);

  /// What the filter starts with: the mean of the start, in the world, and the inner covariance.
  const PoseEstimate& inner() const { return inner_; }

  /// What the outer part adds to the covariance of a pose T_world_robot. (3 x 3)
  Eigen::Matrix3d of_pose(const Pose2& pose) const;
  /// What it adds to that of a landmark at p_world [m]. (2 x 2)
  Eigen::Matrix2d of_point(const Eigen::Vector2d& p_world) const;
  /// Adds it to the joint covariance of [pose | landmarks] (3+2m x 3+2m). `means` (3+2m) are
  /// [x y theta | p_world_landmark ...] [m, rad].
  void add_to(Eigen::Ref<Eigen::MatrixXd> covariance, const Eigen::VectorXd& means) const;

 private:
  /// How a point of the world moves with the start. (2 x 3)
  Eigen::Matrix<double, 2, 3> moved(const Eigen::Vector2d& p_world) const;

  PoseEstimate inner_;
  Eigen::Matrix3d outer_factor_;  // L' of L L' = the outer covariance [m, rad]
};

}  // namespace seif
