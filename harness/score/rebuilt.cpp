#include "harness/score/rebuilt.hpp"

#include <cmath>

namespace harness {

std::optional<double> nees_from_robot(const PosePair& pose, const PointPair& landmark,
                                      const Eigen::Matrix<double, 5, 5>& joint) {
  const Eigen::Vector2d est_p_robot = inverse(pose.est_pose) * landmark.est_point;
  const Eigen::Vector2d true_p_robot = inverse(pose.true_pose) * landmark.true_point;
  const double c = std::cos(pose.est_pose.theta);
  const double s = std::sin(pose.est_pose.theta);
  const Eigen::Matrix2d R_robot_world{{c, s}, {-s, c}};
  Eigen::Matrix<double, 2, 5> J;  // of p_robot = R' (m - p) wrt [x y theta m_x m_y]
  J << -R_robot_world, Eigen::Vector2d(est_p_robot.y(), -est_p_robot.x()), R_robot_world;
  return nees(Eigen::Vector2d(est_p_robot - true_p_robot), Eigen::Matrix2d(J * joint * J.transpose()));
}

}  // namespace harness
