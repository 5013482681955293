// What is frozen with a landmark that leaves the window, and what stays.
#include "seif/freezing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <vector>

#include "allocation_counter.hpp"
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

/// What a piece is over all landmarks, in the order of full_Omega(). (3+2N x 3+2N)
Eigen::MatrixXd whole(const FrozenPiece& piece, const InformationState& state) {
  const Eigen::Index size = InformationState::row_of(state.landmark_count());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < piece.members.size(); ++i) {
    for (std::size_t j = 0; j < piece.members.size(); ++j)
      all.block<2, 2>(3 + 2 * piece.members[i].slot, 3 + 2 * piece.members[j].slot) += piece.block(i, j);
  }
  return all;
}

/// Its residual (3+2N).
Eigen::VectorXd whole_r(const FrozenPiece& piece, const InformationState& state) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(InformationState::row_of(state.landmark_count()));
  for (std::size_t i = 0; i < piece.members.size(); ++i)
    all.segment<2>(3 + 2 * piece.members[i].slot) += Eigen::Vector2d(piece.r[2 * i], piece.r[2 * i + 1]);
  return all;
}

/// Residuals in the window as if the mean were not the latest solution.
void displace(InformationState& state) {
  for (int i = 0; i < state.r().size(); ++i) state.r()(i) = std::sin(i);
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
    FrozenPiece piece;
    ASSERT_TRUE(freeze(state, slots, piece));
    ASSERT_EQ(piece.slots, slots);
    EXPECT_EQ(state.active_count(), 4);
    EXPECT_LT(relative(oracle::symmetric(full_Omega(state)), before), rounding);
    const Eigen::MatrixXd frozen = whole(piece, state);
    for (const int slot : slots) {
      EXPECT_LT((frozen - before).middleRows<2>(3 + 2 * slot).norm(), rounding * before.norm());
    }
  }
}

TEST(Freezing, NothingThatIsFrozenTellsOfPlaceAndHeadingOfTheWhole) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    InformationState state = driven(seed);
    const std::vector<int> slots = unlinked(state);
    FrozenPiece piece;
    ASSERT_TRUE(freeze(state, slots, piece));
    const Eigen::MatrixXd frozen = whole(piece, state);
    Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(frozen.rows(), 3);
    for (const FrozenPiece::Member& m : piece.members)
      modes.middleRows<2>(3 + 2 * m.slot) = modes_of(state, m.slot);
    for (const FrozenPiece::Member& m : piece.members) {
      const auto rows = frozen.middleRows<2>(3 + 2 * m.slot);
      EXPECT_GT(rows.norm(), 0.0);
      EXPECT_LT((rows * modes).norm(), rounding * rows.norm()) << "slot " << m.slot;
    }
  }
}

TEST(Freezing, TheResidualIsSharedWithoutLoss) {
  InformationState state = driven(4);
  const std::vector<int> slots = unlinked(state);
  displace(state);
  const Eigen::VectorXd before = full_r(state);
  FrozenPiece piece;
  ASSERT_TRUE(freeze(state, slots, piece));
  const Eigen::VectorXd now = full_r(state) + whole_r(piece, state);
  EXPECT_LT((now - before).norm(), rounding * before.norm());
}

TEST(Freezing, ABurstIsTheSumOfItsLandmarksOneAfterTheOther) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    InformationState together = driven(seed);
    const std::vector<int> slots = unlinked(together);
    ASSERT_GT(slots.size(), 2U);
    displace(together);
    InformationState each = driven(seed);
    ASSERT_EQ(unlinked(each), slots);
    displace(each);
    FrozenPiece burst;
    ASSERT_TRUE(freeze(together, slots, burst));
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(full_r(each).size(), full_r(each).size());
    Eigen::VectorXd sum_r = Eigen::VectorXd::Zero(sum.rows());
    for (const int slot : slots) {
      FrozenPiece piece;
      ASSERT_TRUE(freeze(each, std::vector{slot}, piece));
      sum += whole(piece, each);
      sum_r += whole_r(piece, each);
    }
    EXPECT_LT(relative(whole(burst, together), sum), 1e-10);
    EXPECT_LT(relative(whole_r(burst, together), sum_r), 1e-10);
    ASSERT_EQ(together.active_count(), each.active_count());
    EXPECT_LT(relative(together.Omega(), each.Omega()), 1e-10);
    EXPECT_LT(relative(together.r(), each.r()), 1e-10);
  }
}

/// In a burst with one that nothing is known of, and with two that only one another tells of.
TEST(Freezing, LandmarksWithoutInformationFreezeNothing) {
  InformationState state = driven(5);
  std::vector<int> slots = unlinked(state);
  displace(state);
  InformationState without = driven(5);
  ASSERT_EQ(unlinked(without), slots);
  displace(without);
  FrozenPiece of_others;
  ASSERT_TRUE(freeze(without, slots, of_others));
  const int unknown = state.add_landmark(100, {3.0, 4.0});
  const int a = state.add_landmark(101, {6.0, 4.0});
  const int b = state.add_landmark(102, {6.0, 5.0});
  for (const int slot : {unknown, a, b}) state.activate(slot);
  const int row_a = InformationState::row_of(state.position(a));
  const int row_b = InformationState::row_of(state.position(b));
  for (const int i : {row_a, row_b}) {
    for (const int j : {row_a, row_b})
      state.Omega().block<2, 2>(i, j) += (i == j ? 400.0 : -400.0) * Eigen::Matrix2d::Identity();
  }
  slots.insert(slots.begin() + 1, {unknown, a});
  slots.push_back(b);
  const Eigen::MatrixXd before = oracle::symmetric(full_Omega(state));
  FrozenPiece piece;
  ASSERT_TRUE(freeze(state, slots, piece));
  EXPECT_EQ(state.active_count(), 4);
  EXPECT_LT(relative(oracle::symmetric(full_Omega(state)), before), rounding);
  for (const FrozenPiece::Member& m : piece.members) EXPECT_NE(m.slot, unknown);
  const Eigen::MatrixXd frozen = whole(piece, state);
  ASSERT_TRUE(frozen.allFinite());
  EXPECT_LT((frozen - before).middleRows<2>(3 + 2 * a).norm(), rounding * before.norm());
  EXPECT_LT((frozen - before).middleRows<2>(3 + 2 * b).norm(), rounding * before.norm());
  const Eigen::MatrixXd expected = whole(of_others, without);
  EXPECT_LT(relative(frozen.topLeftCorner(expected.rows(), expected.cols()), expected), 1e-10);
  const Eigen::VectorXd expected_r = whole_r(of_others, without);
  EXPECT_LT(relative(whole_r(piece, state).head(expected_r.size()), expected_r), 1e-10);
}

TEST(Freezing, RefusesWhatIsNotPositiveSemidefinite) {
  InformationState state = driven(6);
  const std::vector<int> slots = unlinked(state);
  const int row = InformationState::row_of(state.position(slots.back()));
  state.Omega().block<2, 2>(row, row) *= -1.0;
  FrozenPiece piece;
  EXPECT_FALSE(freeze(state, slots, piece));
}

TEST(Freezing, ASecondBurstOfTheSameSizeAllocatesNothing) {
  if (COUNTS_ALLOCATIONS == 0) GTEST_SKIP() << "the sanitizer has a malloc of its own";
  InformationState state = driven(7);
  const std::vector<int> slots = unlinked(state);
  FrozenPiece piece;
  ASSERT_TRUE(freeze(state, slots, piece));  // it makes the links of the graph, too
  for (const int slot : slots) state.activate(slot);
  for (const int slot : slots) {  // observed from a landmark that stayed
    const int row = InformationState::row_of(state.position(slot));
    const int other = InformationState::row_of(0);
    for (const int i : {row, other}) {
      for (const int j : {row, other})
        state.Omega().block<2, 2>(i, j) += (i == j ? 400.0 : -400.0) * Eigen::Matrix2d::Identity();
    }
  }
  const long before = allocations();
  ASSERT_TRUE(freeze(state, slots, piece));
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(piece.members.size(), slots.size() + 1);
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
