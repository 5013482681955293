// Dead reckoning of a differential drive: computes its motion from the distances that its wheels rolled.
#pragma once

#include <Eigen/Core>

#include "seif/types.hpp"

namespace sensors {

/// The distance that each wheel rolled along the ground.
struct WheelDistances {
  double left = 0.0;   // [m]
  double right = 0.0;  // [m]
};

/// A motion along a circular arc, and its Jacobian with respect to the wheels' distances.
struct WheelArc {
  seif::Pose2 T_start_end;  // [m, rad]
  Eigen::Matrix<double, 3, 2> J_arc_wrt_wheels =
      Eigen::Matrix<double, 3, 2>::Zero();  // (3 x 2) [x y theta] by [left right]
};

/// The motion of the middle of the axle. It is exact if both wheels keep their speeds (constant curvature).
/// `track` [m] is positive.
WheelArc wheel_arc(const WheelDistances& distances, double track);

}  // namespace sensors
