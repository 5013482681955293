#include "harness/statistics/ellipse.hpp"

#include <Eigen/Eigenvalues>

namespace harness {

Eigen::Matrix2d ellipse_axes(const Eigen::Matrix2d& covariance, double sigmas) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance);
  return sigmas * eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

}  // namespace harness
