// A position and heading on the ground.
#pragma once

#include <Eigen/Core>

namespace worlds {

/// Position and heading of something on the ground.
struct Placement {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // p_world [m]
  double heading = 0.0;                                // [rad] in (-pi, pi]
};

}  // namespace worlds
