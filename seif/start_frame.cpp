#include "seif/start_frame.hpp"

#include <Eigen/Cholesky>
#include <stdexcept>

namespace seif {
namespace {

constexpr double D = 1e-3;  // [m, rad]

/// X' X, symmetric to the bit.
template <class Matrix>
auto squared(const Matrix& X) {
  const auto Y = X.eval();
  return (Y.transpose() * Y).eval();
}

}  // namespace

StartFrame::StartFrame(const PoseEstimate& start) : inner_(start) {
  const Eigen::Matrix3d& Sigma = start.covariance;
  const Eigen::LLT<Eigen::Matrix3d> llt(Sigma);
  if (llt.info() != Eigen::Success)
    throw std::invalid_argument("the covariance of the start estimate is not positive definite");
  const auto I = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d L = llt.matrixL();
  // L (I + L' L / D^2)^-1 L': positive definite to rounding, however unlike the standard deviations are
  inner_.covariance = squared(Eigen::LLT<Eigen::Matrix3d>(I + squared(L / D)).matrixL().solve(L.transpose()));
  outer_factor_ = Eigen::LLT<Eigen::Matrix3d>(Sigma + D * D * I).matrixL().solve(Sigma);
}

Eigen::Matrix<double, 2, 3> StartFrame::moved(const Eigen::Vector2d& p_world) const {
  Eigen::Matrix<double, 2, 3> J;
  J << 1.0, 0.0, inner_.mean.y - p_world.y(), 0.0, 1.0, p_world.x() - inner_.mean.x;
  return J;
}

Eigen::Matrix3d StartFrame::of_pose(const Pose2& pose) const {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J.topRows<2>() = moved({pose.x, pose.y});
  return squared(outer_factor_ * J.transpose());
}

Eigen::Matrix2d StartFrame::of_point(const Eigen::Vector2d& p_world) const {
  const Eigen::Matrix<double, 2, 3> J = moved(p_world);
  return squared(outer_factor_ * J.transpose());
}

void StartFrame::add_to(Eigen::Ref<Eigen::MatrixXd> covariance, const Eigen::VectorXd& means) const {
  Eigen::MatrixXd J(means.size(), 3);
  J.topRows<3>().setIdentity();
  J.topRows<2>() = moved(means.head<2>());
  for (Eigen::Index row = 3; row < means.size(); row += 2)
    J.middleRows<2>(row) = moved(means.segment<2>(row));
  covariance += squared(outer_factor_ * J.transpose());
}

}  // namespace seif
