// What lies around the robot, as it saw it since it lost its place, and how a filter is put back by it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "seif/types.hpp"

namespace seif {

/// Landmarks around the robot, in its own frame. They say nothing of where the robot is.
struct Surroundings {
  std::vector<LandmarkId> landmarks;  // k of them
  Eigen::VectorXd p_robot;            // p_robot_landmark, one after the other (2k) [m]
  Eigen::MatrixXd covariance;         // of p_robot (2k x 2k) [m^2]; positive definite

  std::size_t size() const { return landmarks.size(); }
  Eigen::Vector2d at(std::size_t i) const { return p_robot.segment<2>(2 * static_cast<Eigen::Index>(i)); }
};

/// Puts the robot where its surroundings are in the map.
struct Relocation {
  Pose2 T_world_robot;  // where they are linearised: their best fit to the map
  /// Named as in the map of the filter; those that it does not know join. It knows at least two of them.
  Surroundings surroundings;
  /// What is known of the pose stays, as in any measurement update. Otherwise the pose is marginalised out first, and
  /// only the surroundings say where the robot is.
  bool keeps_pose = false;
};

/// How a landmark is expected in the frame of the robot: p_robot = R' (p_world - p), and its Jacobians.
struct ExpectedPlace {
  Eigen::Vector2d p_robot;
  Eigen::Matrix<double, 2, 3> J_x;  // wrt the pose
  Eigen::Matrix2d J_m;              // wrt the landmark
};

/// `lever`: from the pose to the landmark, where the column of the heading is linearised [m].
ExpectedPlace expect_place(const Pose2& T_world_robot, const Eigen::Vector2d& p_world_landmark,
                           const Eigen::Vector2d& lever);
/// The same, linearised where both are.
ExpectedPlace expect_place(const Pose2& T_world_robot, const Eigen::Vector2d& p_world_landmark);

}  // namespace seif
