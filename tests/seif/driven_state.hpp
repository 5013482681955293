// Information states after a random drive, with passive landmarks and links between them.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "dense_oracle.hpp"
#include "seif/information_state.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/measurement_update.hpp"
#include "seif/motion_update.hpp"
#include "seif/sparsification.hpp"

namespace seif::test {

const inline PoseEstimate start{
    .mean = {0.1, -0.2, 0.3}, .covariance = Eigen::Vector3d(0.01, 0.02, 0.001).asDiagonal().toDenseMatrix()};
const inline Pose2 T_robot_sensor{0.15, -0.05, 0.2};

inline double relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

/// Continues the drive with the report's filter: at most 5 active landmarks, and a mean that is never exact.
inline void drive(InformationState& state, oracle::RandomDrive& random, int updates) {
  std::vector<int> surplus;
  Pose2 T_world_robot = state.pose();
  for (int k = 0; k < updates; ++k) {
    const Odometry u = random.odometry();
    T_world_robot = T_world_robot * u.T_previous_current;
    motion_update(state, u);
    std::vector<Observation> scan;
    for (int i = 0; i < 3; ++i) {
      const auto landmark = static_cast<LandmarkId>(random.uniform(0, 20));
      scan.push_back(random.observation(landmark, T_world_robot * T_robot_sensor,
                                        {1.0 + landmark % 5 - 0.1 * landmark, -2.0 + 0.4 * landmark}));
    }
    measurement_update(state, scan, T_robot_sensor);
    if (state.active_count() > 5) {
      choose_to_drop(state, DropOrder::weakest_link, state.active_count() - 5, surplus);
      ASSERT_TRUE(sparsify(state, SparsificationRule::report, surplus));
    }
    ASSERT_TRUE(coordinate_descent(state, 2, random.random));
  }
}

}  // namespace seif::test
