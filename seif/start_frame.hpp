// The frame of the start. Robot and map turn and move with the start as one, and no observation tells how far. So
// a filter can estimate as if it knew its start, and add what the start is uncertain of when it tells a covariance.
// A linear filter that holds the uncertainty of the start itself may turn the whole map by it, along a straight
// line where it should follow a circle: then the map grows.
#pragma once

#include <Eigen/Core>

#include "seif/types.hpp"

namespace seif {

class StartFrame {
 public:
  /// Throws std::invalid_argument if the start covariance is not positive definite.
  explicit StartFrame(const PoseEstimate& start);

  /// The start as it is in its own frame: known to a micrometre and a microradian, since information must be
  /// finite. The mean stays that in the world, and so do all means.
  PoseEstimate known() const;

  /// Adds to the joint covariance of [pose | landmarks] (3+2m x 3+2m) what the start contributes. `means` (3+2m)
  /// are [x y theta | p_world_landmark ...] [m, rad].
  void add_uncertainty(const Eigen::VectorXd& means, Eigen::Ref<Eigen::MatrixXd> covariance) const;

  /// What the start contributes to the covariance of a pose, and of a landmark at p_world [m].
  Eigen::Matrix3d of_pose(const Pose2& pose) const;
  Eigen::Matrix2d of_point(const Eigen::Vector2d& p_world) const;

 private:
  /// How a point of the world moves with the start: (2 x 3) [1 0 -y | 0 1 x] of the vector from the start.
  Eigen::Matrix<double, 2, 3> moved(const Eigen::Vector2d& p_world) const;

  PoseEstimate start_;
};

}  // namespace seif
