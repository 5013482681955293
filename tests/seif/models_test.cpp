#include "seif/models.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace seif {
namespace {

constexpr double difference_step = 1e-6;  // of the central differences
// The error of these: the square of the step times third derivatives, and rounding over the step.
constexpr double tolerance = 1e-8;

const std::array<Pose2, 5> poses{{{0, 0, 0}, {1, -2, 0.7}, {-3, 5, 3.1}, {10, 0.5, -3.1}, {0.2, 0.1, -1.5}}};
const std::array<Pose2, 4> increments{{{0.3, 0, 0}, {0.3, 0.02, 0.4}, {0, 0, 1.0}, {-0.2, 0.01, -0.3}}};
const std::array<Pose2, 2> mounts{{{0, 0, 0}, {0.2, -0.1, 0.5}}};
const Eigen::Vector2d p_landmark(2.5, 3.5);

Pose2 shifted(Pose2 pose, int coordinate, double by) {
  std::array<double*, 3>{&pose.x, &pose.y, &pose.theta}[static_cast<std::size_t>(coordinate)][0] += by;
  return pose;
}

Eigen::Vector3d difference(const Pose2& a, const Pose2& b) {
  return {a.x - b.x, a.y - b.y, wrap_angle(a.theta - b.theta)};
}

TEST(PredictPose, HasTheJacobianOfItsCentralDifferences) {
  for (const Pose2& pose : poses) {
    for (const Pose2& increment : increments) {
      const Odometry u{.t = 0, .T_previous_current = increment};
      const PredictedPose predicted = predict_pose(pose, u);
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d numeric = difference(predict_pose(shifted(pose, i, difference_step), u).pose,
                                                   predict_pose(shifted(pose, i, -difference_step), u).pose) /
                                        (2 * difference_step);
        EXPECT_LT((predicted.J_wrt_pose.col(i) - numeric).norm(), tolerance);
      }
    }
  }
}

TEST(PredictPose, TurnsTheNoiseOfTheIncrementIntoTheWorld) {
  Eigen::Matrix3d covariance;
  covariance << 4e-4, 1e-4, 0, 1e-4, 1e-4, 0, 0, 0, 9e-4;
  for (const Pose2& pose : poses) {
    const Odometry u{.t = 0, .T_previous_current = {0.3, 0.1, 0.2}, .covariance = covariance};
    const PredictedPose predicted = predict_pose(pose, u);
    Eigen::Matrix3d J;  // wrt the increment
    for (int i = 0; i < 3; ++i) {
      J.col(i) = difference(pose * shifted(u.T_previous_current, i, difference_step),
                            pose * shifted(u.T_previous_current, i, -difference_step)) /
                 (2 * difference_step);
    }
    const Eigen::Matrix3d R = predicted.noise_factor * predicted.noise_factor.transpose();
    EXPECT_LT((R - J * covariance * J.transpose()).norm(), 1e-12);
  }
}

TEST(PredictPose, TakesNoiseOfAnyRank) {
  const Eigen::Vector3d a(0.1, 0.02, -0.3);
  const Eigen::Vector3d b(0.0, 0.05, 0.1);
  for (const Eigen::Matrix3d& covariance :
       {Eigen::Matrix3d(Eigen::Matrix3d::Zero()), Eigen::Matrix3d(a * a.transpose()),
        Eigen::Matrix3d(a * a.transpose() + b * b.transpose())}) {
    const Odometry u{.t = 0, .T_previous_current = {0.3, 0.1, 0.2}, .covariance = covariance};
    const Eigen::Matrix3d L = predict_pose(Pose2{}, u).noise_factor;
    EXPECT_LT((L * L.transpose() - covariance).norm(), 1e-15);
  }
}

TEST(PredictObservation, HasTheJacobiansOfItsCentralDifferences) {
  for (const Pose2& pose : poses) {
    for (const Pose2& mount : mounts) {
      const PredictedObservation predicted = predict_observation(pose, mount, p_landmark);
      const auto numeric = [](const Eigen::Vector2d& plus, const Eigen::Vector2d& minus) {
        return Eigen::Vector2d((plus.x() - minus.x()) / (2 * difference_step),
                               wrap_angle(plus.y() - minus.y()) / (2 * difference_step));
      };
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector2d column =
            numeric(predict_observation(shifted(pose, i, difference_step), mount, p_landmark).z,
                    predict_observation(shifted(pose, i, -difference_step), mount, p_landmark).z);
        EXPECT_LT((predicted.J_wrt_pose.col(i) - column).norm(), tolerance);
      }
      for (int i = 0; i < 2; ++i) {
        const Eigen::Vector2d d = difference_step * Eigen::Vector2d::Unit(i);
        const Eigen::Vector2d column = numeric(predict_observation(pose, mount, p_landmark + d).z,
                                               predict_observation(pose, mount, p_landmark - d).z);
        EXPECT_LT((predicted.J_wrt_landmark.col(i) - column).norm(), tolerance);
      }
    }
  }
}

TEST(PredictObservation, StaysFiniteAtTheSensorItself) {
  const PredictedObservation predicted = predict_observation({1, 2, 0.3}, {}, {1, 2});
  EXPECT_TRUE(predicted.z.allFinite());
  EXPECT_TRUE(predicted.J_wrt_pose.allFinite());
  EXPECT_TRUE(predicted.J_wrt_landmark.allFinite());
}

TEST(Innovation, WrapsTheBearing) {
  const Observation z{.landmark = 0, .range = 2.0, .bearing = 3.1};
  const Eigen::Vector2d v = innovation(z, {1.5, -3.1});
  EXPECT_NEAR(v.x(), 0.5, 1e-15);
  EXPECT_NEAR(v.y(), 6.2 - 2 * std::numbers::pi, 1e-15);
}

TEST(InvertObservation, UndoesThePredictionAndHasItsJacobians) {
  for (const Pose2& pose : poses) {
    for (const Pose2& mount : mounts) {
      const PredictedObservation predicted = predict_observation(pose, mount, p_landmark);
      const auto inverted = [&](const Pose2& from, double dr, double db) {
        const Observation z{.landmark = 0, .range = predicted.z.x() + dr, .bearing = predicted.z.y() + db};
        return invert_observation(from, mount, z);
      };
      const InverseObservation inverse = inverted(pose, 0, 0);
      EXPECT_LT((inverse.p_world_landmark - p_landmark).norm(), 1e-14);
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector2d column = (inverted(shifted(pose, i, difference_step), 0, 0).p_world_landmark -
                                        inverted(shifted(pose, i, -difference_step), 0, 0).p_world_landmark) /
                                       (2 * difference_step);
        EXPECT_LT((inverse.J_wrt_pose.col(i) - column).norm(), tolerance);
      }
      const Eigen::Vector2d wrt_range = (inverted(pose, difference_step, 0).p_world_landmark -
                                         inverted(pose, -difference_step, 0).p_world_landmark) /
                                        (2 * difference_step);
      const Eigen::Vector2d wrt_bearing = (inverted(pose, 0, difference_step).p_world_landmark -
                                           inverted(pose, 0, -difference_step).p_world_landmark) /
                                          (2 * difference_step);
      EXPECT_LT((inverse.J_wrt_observation.col(0) - wrt_range).norm(), tolerance);
      EXPECT_LT((inverse.J_wrt_observation.col(1) - wrt_bearing).norm(), tolerance);
    }
  }
}

}  // namespace
}  // namespace seif
