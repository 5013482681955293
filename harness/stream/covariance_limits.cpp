#include "harness/stream/covariance_limits.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace harness {

namespace {

constexpr double largest_pose_sd = 1e4;  // [m, rad]

std::string above(double variance, double largest) {
  if (variance <= largest * largest) return "";
  return fmt::format("this covariance has an error of {:.3g} m or rad; the largest allowed is {:g}",
                     std::sqrt(variance), largest);
}

/// The diagonal of Cholesky's factor holds the error of each component when those before it are known.
template <int Size>
std::string problem_of(const Eigen::Matrix<double, Size, Size>& covariance, double largest) {
  const Eigen::LLT<Eigen::Matrix<double, Size, Size>> llt(covariance);
  if (llt.info() != Eigen::Success) return "this covariance is not positive definite";
  const double least = llt.matrixLLT().diagonal().minCoeff();
  if (least < least_sd)
    return fmt::format("this covariance has an error of {:.3g} m or rad; the least allowed is {:g}", least,
                       least_sd);
  return above(covariance.diagonal().maxCoeff(), largest);
}

}  // namespace

std::string problem_of_observation(const Eigen::Matrix2d& covariance) {
  return problem_of(covariance, largest_observation_sd);
}

std::string problem_of_start(const Eigen::Matrix3d& covariance) {
  return problem_of(covariance, largest_pose_sd);
}

std::string problem_of_motion(const Eigen::Matrix3d& covariance) {
  return above(covariance.diagonal().maxCoeff(), largest_pose_sd);
}

}  // namespace harness
