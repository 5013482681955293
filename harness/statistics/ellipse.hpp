// The ellipses that show a covariance in the plane.
#pragma once

#include <Eigen/Core>

namespace harness {

/// The semi-axes of the ellipse at `sigmas` standard deviations, as columns, the shorter one first. (2 x 2)
Eigen::Matrix2d ellipse_axes(const Eigen::Matrix2d& covariance, double sigmas);

}  // namespace harness
