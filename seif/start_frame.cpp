#include "seif/start_frame.hpp"

#include <Eigen/Cholesky>
#include <stdexcept>

namespace seif {
namespace {

constexpr double known_sd = 1e-6;  // [m, rad]

}  // namespace

StartFrame::StartFrame(const PoseEstimate& start) : start_(start) {
  if (start.covariance.llt().info() != Eigen::Success)
    throw std::invalid_argument("the covariance of the start estimate is not positive definite");
}

PoseEstimate StartFrame::known() const {
  return {start_.mean, known_sd * known_sd * Eigen::Matrix3d::Identity()};
}

Eigen::Matrix<double, 2, 3> StartFrame::moved(const Eigen::Vector2d& p_world) const {
  Eigen::Matrix<double, 2, 3> J;
  J << 1.0, 0.0, start_.mean.y - p_world.y(), 0.0, 1.0, p_world.x() - start_.mean.x;
  return J;
}

Eigen::Matrix3d StartFrame::of_pose(const Pose2& pose) const {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J.topRows<2>() = moved({pose.x, pose.y});
  return J * start_.covariance * J.transpose();
}

Eigen::Matrix2d StartFrame::of_point(const Eigen::Vector2d& p_world) const {
  const Eigen::Matrix<double, 2, 3> J = moved(p_world);
  return J * start_.covariance * J.transpose();
}

void StartFrame::add_uncertainty(const Eigen::VectorXd& means,
                                 Eigen::Ref<Eigen::MatrixXd> covariance) const {
  Eigen::MatrixXd J(means.size(), 3);
  J.topRows<3>() = Eigen::Matrix3d::Identity();
  J.topRows<2>() = moved(means.head<2>());
  for (Eigen::Index row = 3; row < means.size(); row += 2) J.middleRows<2>(row) = moved(means.segment<2>(row));
  covariance += J * start_.covariance * J.transpose();
}

}  // namespace seif
