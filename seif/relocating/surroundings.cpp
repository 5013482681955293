#include "seif/relocating/surroundings.hpp"

#include <Eigen/Geometry>

namespace seif {

ExpectedPlace expect_place(const Pose2& T_world_robot, const Eigen::Vector2d& p_world_landmark,
                           const Eigen::Vector2d& lever) {
  const Eigen::Matrix2d R_robot_world = Eigen::Rotation2Dd(-T_world_robot.theta).toRotationMatrix();
  ExpectedPlace expected;
  expected.p_robot = R_robot_world * (p_world_landmark - Eigen::Vector2d(T_world_robot.x, T_world_robot.y));
  expected.J_m = R_robot_world;
  expected.J_x << -R_robot_world, R_robot_world * Eigen::Vector2d(lever.y(), -lever.x());
  return expected;
}

ExpectedPlace expect_place(const Pose2& T_world_robot, const Eigen::Vector2d& p_world_landmark) {
  return expect_place(T_world_robot, p_world_landmark,
                      p_world_landmark - Eigen::Vector2d(T_world_robot.x, T_world_robot.y));
}

}  // namespace seif
