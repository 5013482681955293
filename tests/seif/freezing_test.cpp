// What is frozen with a landmark that leaves the window, and what stays.
#include "seif/freezing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "dense_oracle.hpp"
#include "driven_state.hpp"
#include "seif/full_state.hpp"
#include "seif/information_state.hpp"
#include "seif/linearisation.hpp"
#include "seif/measurement_steps.hpp"
#include "seif/motion_update.hpp"
#include "seif/sparsification.hpp"
#include "seif/start_points.hpp"

namespace seif {
namespace {

using test::relative;
using test::T_robot_sensor;

constexpr double rounding = 1e-9;  // [-] of sums and of null vectors

/// A robot on a circle of 2 m among ten landmarks, after some steps, with frozen information apart and its start
/// told by points. The mean is the prediction.
InformationState driven(unsigned seed) {
  oracle::RandomDrive random(seed);
  InformationState state({.mean = {0.1, -0.2, 0.3}, .covariance = 1e-6 * Eigen::Matrix3d::Identity()});
  state.keep_frozen_apart();
  state.first_estimates().settle_after(2);
  relate_to_start(state, 1e-6 * Eigen::Matrix3d::Identity());
  Pose2 truth = state.pose();
  for (int k = 0; k < 12; ++k) {
    const Odometry u{
        .t = 0.0, .T_previous_current = {0.3, 0.0, 0.15}, .covariance = random.odometry().covariance};
    truth = truth * u.T_previous_current;
    motion_update(state, u);
    Scan scan;
    for (int i = 0; i < 10; ++i) {
      const Eigen::Vector2d p(5.0 * std::cos(0.63 * i), 2.0 + 5.0 * std::sin(0.63 * i));
      if ((inverse(truth) * p).norm() < 5.0)
        scan.observations.push_back(random.observation(i, truth * T_robot_sensor, p));
    }
    std::vector<ObservationFactor> factors;
    linearise_known(state, scan, T_robot_sensor, 0.0, factors);
    for (const ObservationFactor& factor : factors) add(state, factor);
    for (const Observation& z : scan.observations) {
      if (state.find(z.landmark)) continue;
      const int slot = state.add_landmark(
          z.landmark, invert_observation(state.pose(), T_robot_sensor, z).p_world_landmark);
      add(state, linearise(state, slot, z, T_robot_sensor));
    }
    update_first_estimates(state);
  }
  return state;
}

std::vector<int> unlinked(InformationState& state) {
  std::vector<int> slots;
  choose_to_drop(state, DropOrder::least_recently_seen, state.active_count() - 4, slots);
  EXPECT_TRUE(sparsify(state, SparsificationRule::gauge_free, slots));
  return slots;
}

/// Both translations, and the turn about the origin, at the point where a landmark is linearised. (2 x 3)
Eigen::Matrix<double, 2, 3> modes_of(const InformationState& state, int slot) {
  const Eigen::Vector2d p = linearisation_point(state, slot);
  return (Eigen::Matrix<double, 2, 3>() << 1, 0, -p.y(), 0, 1, p.x()).finished();
}

TEST(Freezing, WhatIsFrozenAndWhatStaysAreTheWhole) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    InformationState state = driven(seed);
    const std::vector<int> slots = unlinked(state);
    const Eigen::MatrixXd before = oracle::symmetric(full_Omega(state));
    std::vector<FrozenPiece> pieces;
    ASSERT_TRUE(freeze(state, slots, pieces));
    ASSERT_EQ(pieces.size(), slots.size());
    EXPECT_EQ(state.active_count(), 4);
    EXPECT_LT(relative(oracle::symmetric(full_Omega(state)), before), rounding);
    Eigen::MatrixXd frozen = Eigen::MatrixXd::Zero(before.rows(), before.cols());
    for (const FrozenPiece& piece : pieces) {
      for (const FrozenPiece::Member& m : piece.members) {
        for (const FrozenPiece::Member& n : piece.members)
          frozen.block<2, 2>(3 + 2 * m.slot, 3 + 2 * n.slot) += m.V * n.V.transpose();
      }
    }
    for (const int slot : slots) {
      EXPECT_LT((frozen - before).middleRows<2>(3 + 2 * slot).norm(), rounding * before.norm());
    }
  }
}

TEST(Freezing, NothingThatIsFrozenTellsOfPlaceAndHeadingOfTheWhole) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    InformationState state = driven(seed);
    const std::vector<int> slots = unlinked(state);
    std::vector<FrozenPiece> pieces;
    ASSERT_TRUE(freeze(state, slots, pieces));
    for (const FrozenPiece& piece : pieces) {
      Eigen::Matrix<double, 2, 3> sum = Eigen::Matrix<double, 2, 3>::Zero();
      double size = 0.0;
      for (const FrozenPiece::Member& m : piece.members) {
        sum += m.V.transpose() * modes_of(state, m.slot);
        size += m.V.norm();
      }
      EXPECT_GT(size, 0.0);
      EXPECT_LT(sum.norm(), rounding * size) << "slot " << piece.slot;
    }
  }
}

TEST(Freezing, TheResidualIsSharedWithoutLoss) {
  InformationState state = driven(4);
  const std::vector<int> slots = unlinked(state);
  for (int i = 0; i < state.r().size(); ++i) state.r()(i) = std::sin(i);
  const Eigen::VectorXd before = full_r(state);
  std::vector<FrozenPiece> pieces;
  ASSERT_TRUE(freeze(state, slots, pieces));
  Eigen::VectorXd now = full_r(state);
  for (const FrozenPiece& piece : pieces) {
    for (const FrozenPiece::Member& m : piece.members) now.segment<2>(3 + 2 * m.slot) += m.V * piece.y;
  }
  EXPECT_LT((now - before).norm(), rounding * before.norm());
}

TEST(StartPoints, TellWhereTheRobotBeganAndNothingOfPlaceAndHeading) {
  const Eigen::Matrix3d covariance = Eigen::Vector3d(1e-6, 2e-6, 3e-6).asDiagonal();
  InformationState state({.mean = {1.0, -2.0, 0.7}, .covariance = covariance});
  relate_to_start(state, covariance);
  Eigen::MatrixXd Omega = state.Omega();
  Eigen::MatrixXd N(7, 3);
  N << 1, 0, 2, 0, 1, 1, 0, 0, 1, modes_of(state, 0), modes_of(state, 1);
  EXPECT_LT((Omega * N).norm(), rounding * Omega.norm());
  Omega.bottomRightCorner<4, 4>() += 1e14 * Eigen::Matrix4d::Identity();  // the points are where they are
  EXPECT_LT(relative(Omega.inverse().topLeftCorner<3, 3>(), covariance), 1e-4);
}

}  // namespace
}  // namespace seif
