// Where something lies on the ground.
#pragma once

#include <Eigen/Core>

namespace worlds {

/// Where something stands on the plane.
struct Placement {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // p_world [m]
  double heading = 0.0;                                // [rad] in (-pi, pi]
};

}  // namespace worlds
