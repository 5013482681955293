// Each step of the SEIF against the dense oracle, on states after a random drive.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <stdexcept>
#include <vector>

#include "dense_oracle.hpp"
#include "driven_state.hpp"
#include "seif/full_state.hpp"
#include "seif/information_state.hpp"
#include "seif/marginals.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/measurement_update.hpp"
#include "seif/motion_update.hpp"
#include "seif/relocation.hpp"
#include "seif/sparsification.hpp"

namespace seif {
namespace {

using oracle::DenseBelief;
using oracle::RandomDrive;
using test::drive;
using test::relative;
using test::start;
using test::T_robot_sensor;

constexpr double step_rounding = 1e-10;  // relative, after some tens of updates of conditioned matrices

void expect_equal(const InformationState& state, const DenseBelief& belief) {
  const DenseBelief now = oracle::dense(state);
  EXPECT_LT(relative(now.H, belief.H), step_rounding);
  EXPECT_LT(relative(now.b, belief.b), step_rounding);
  EXPECT_LT(relative(now.mu, belief.mu), step_rounding);
}

class SeifSteps : public testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override { drive(state, random, 25); }

  RandomDrive random{GetParam()};
  InformationState state{start};
};

INSTANTIATE_TEST_SUITE_P(Seeds, SeifSteps, testing::Values(1U, 2U, 3U, 4U, 5U));

TEST_P(SeifSteps, MotionUpdateMatchesTheDenseInverses) {
  DenseBelief belief = oracle::dense(state);
  for (int k = 0; k < 4; ++k) {
    const Odometry u = random.odometry();
    oracle::motion_update(belief, u);
    motion_update(state, u);
    expect_equal(state, belief);
  }
}

TEST_P(SeifSteps, MotionUpdateIsExactWithoutNoise) {
  DenseBelief belief = oracle::dense(state);
  Odometry u = random.odometry();
  u.covariance.setZero();
  oracle::motion_update(belief, u);
  motion_update(state, u);
  expect_equal(state, belief);
}

TEST_P(SeifSteps, MeasurementUpdateMatchesTheDenseFormAndActivates) {
  DenseBelief belief = oracle::dense(state);
  const Pose2 T_world_sensor = state.pose() * T_robot_sensor;
  std::vector<Observation> scan;
  for (int slot = 0; slot < state.landmark_count(); slot += 2) {
    scan.push_back(random.observation(state.id(slot), T_world_sensor, state.mean(slot)));
  }
  scan.push_back(random.observation(77, T_world_sensor, {3.0, 1.0}));
  for (const Observation& z : scan) {
    if (!state.find(z.landmark)) {
      oracle::add_landmark(belief, invert_observation(state.pose(), T_robot_sensor, z).p_world_landmark);
    }
  }
  EXPECT_EQ(measurement_update(state, scan, T_robot_sensor), 1);
  for (const Observation& z : scan) {
    const int slot = state.find(z.landmark).value();
    oracle::measurement_update(belief, slot, z, T_robot_sensor);
    EXPECT_GE(state.position(slot), 0);
  }
  expect_equal(state, belief);
}

std::vector<int> active_slots(const InformationState& state) {
  std::vector<int> slots;
  for (int position = 0; position < state.active_count(); ++position) slots.push_back(state.active(position));
  return slots;
}

TEST_P(SeifSteps, SparsificationMatchesEquation50) {
  const Eigen::MatrixXd before = oracle::dense(state).H;
  const Eigen::MatrixXd H0 = oracle::conditioned(before, active_slots(state));
  std::vector<int> dropped;
  choose_to_drop(state, DropOrder::weakest_link, 3, dropped);
  ASSERT_TRUE(sparsify(state, SparsificationRule::report, dropped));
  EXPECT_LT(relative(oracle::symmetric(full_Omega(state)), oracle::sparsified(before, H0, dropped)),
            step_rounding);
}

TEST_P(SeifSteps, ModifiedSparsificationMatchesEquation50WithTheMarginal) {
  const Eigen::MatrixXd before = oracle::dense(state).H;
  const Eigen::MatrixXd H0 = oracle::marginalised(before, active_slots(state));
  std::vector<int> dropped;
  choose_to_drop(state, DropOrder::weakest_link, 3, dropped);
  ASSERT_TRUE(sparsify(state, SparsificationRule::modified, dropped));
  EXPECT_LT(relative(oracle::symmetric(full_Omega(state)), oracle::sparsified(before, H0, dropped)),
            1e-8);  // inverses
}

TEST_P(SeifSteps, GaugeFreeSparsificationMatchesEquation50WithTheFloatedWindow) {
  const Eigen::MatrixXd before = oracle::dense(state).H;
  const Eigen::MatrixXd H0 = oracle::floated(before, full_mu(state), active_slots(state));
  std::vector<int> dropped;
  choose_to_drop(state, DropOrder::least_recently_seen, 3, dropped);
  ASSERT_TRUE(sparsify(state, SparsificationRule::gauge_free, dropped));
  EXPECT_LT(relative(oracle::symmetric(full_Omega(state)), oracle::sparsified(before, H0, dropped)),
            1e-8);  // inverses
}

TEST_P(SeifSteps, ModifiedSparsificationKeepsTheUncertaintyOfThePoseWhereTheReportsRuleShrinksIt) {
  const auto log_det_pose = [](const InformationState& s) {
    return std::log(oracle::inverse(oracle::symmetric(full_Omega(s))).topLeftCorner<3, 3>().determinant());
  };
  const double before = log_det_pose(state);
  InformationState by_report(start);
  RandomDrive same(GetParam());
  drive(by_report, same, 25);
  std::vector<int> dropped;
  choose_to_drop(state, DropOrder::weakest_link, 3, dropped);
  ASSERT_TRUE(sparsify(state, SparsificationRule::modified, dropped));
  ASSERT_TRUE(sparsify(by_report, SparsificationRule::report, dropped));
  EXPECT_NEAR(log_det_pose(state), before, 1e-6);
  EXPECT_LT(log_det_pose(by_report), before - 0.01);
}

TEST_P(SeifSteps, SparsificationKeepsTheMeanAndClearsTheLinks) {
  const Eigen::VectorXd mu = full_mu(state);
  const Eigen::VectorXd r = full_r(state);
  const int active = state.active_count();
  std::vector<int> dropped;
  choose_to_drop(state, DropOrder::weakest_link, 3, dropped);
  ASSERT_TRUE(sparsify(state, SparsificationRule::report, dropped));
  EXPECT_EQ(full_r(state), r);  // (51): b~ - H~ mu = b - H mu
  EXPECT_EQ(full_mu(state), mu);
  EXPECT_EQ(state.active_count(), active - 3);
  const Eigen::MatrixXd H = oracle::symmetric(full_Omega(state));
  for (const int slot : dropped) {
    EXPECT_EQ(state.position(slot), -1);
    EXPECT_TRUE(H.block(0, InformationState::row_of(slot), 3, 2).isZero(0.0));
  }
}

TEST_P(SeifSteps, SparsificationKeepsTheMarginalOfTheMap) {
  const auto map_covariance = [](const InformationState& s) {
    const auto n = 2 * s.landmark_count();
    return Eigen::MatrixXd(oracle::inverse(oracle::symmetric(full_Omega(s))).bottomRightCorner(n, n));
  };
  const Eigen::MatrixXd before = map_covariance(state);
  std::vector<int> dropped;
  choose_to_drop(state, DropOrder::weakest_link, 2, dropped);
  ASSERT_TRUE(sparsify(state, SparsificationRule::report, dropped));
  EXPECT_LT(relative(map_covariance(state), before), 1e-8);  // two inverses
}

TEST_P(SeifSteps, MarginalisingTheRobotOutKeepsTheBeliefOverTheMap) {
  const auto n = 2 * state.landmark_count();
  DenseBelief before = oracle::dense(state);
  oracle::recover_mean(before);
  const Eigen::MatrixXd Sigma = oracle::inverse(before.H);
  ASSERT_TRUE(marginalise_robot(state));

  const DenseBelief after = oracle::dense(state);
  EXPECT_EQ(state.active_count(), 0);
  EXPECT_TRUE(after.H.topRows(3).isZero(0.0));
  EXPECT_TRUE(full_r(state).head<3>().isZero(0.0));
  const Eigen::MatrixXd H_mm = after.H.bottomRightCorner(n, n);
  const Eigen::VectorXd map_mean = after.mu.tail(n) + oracle::solve(H_mm, full_r(state).tail(n));
  EXPECT_LT(relative(oracle::inverse(H_mm), Sigma.bottomRightCorner(n, n)), 1e-8);  // inverses
  EXPECT_LT((map_mean - before.mu.tail(n)).norm(), 1e-9);
}

TEST_P(SeifSteps, CoordinateDescentReachesTheExactMeanIfRepeated) {
  DenseBelief belief = oracle::dense(state);
  oracle::recover_mean(belief);
  const double error = (full_mu(state) - belief.mu).norm();
  ASSERT_GT(error, 1e-4);
  const auto energy = [&] { return full_r(state).dot(oracle::solve(belief.H, full_r(state))); };
  double last = energy();
  for (int sweep = 0; sweep < 2'000; ++sweep) {  // relaxation is slow; only its path is tested here
    ASSERT_TRUE(coordinate_descent(state, 20, random.random));
    if (sweep % 100 != 0) continue;
    const double now = energy();
    ASSERT_LE(now, last * (1 + 1e-9));  // each step lowers the error, Lemma 4
    last = now;
  }
  EXPECT_LT((full_mu(state) - belief.mu).norm(), 0.1 * error);
}

TEST_P(SeifSteps, SolvingForTheMeanGivesThatOfTheDenseInverse) {
  DenseBelief belief = oracle::dense(state);
  oracle::recover_mean(belief);
  ASSERT_TRUE(solve_mean(state));
  EXPECT_LT((full_mu(state) - belief.mu).norm(), 1e-9);
}

TEST_P(SeifSteps, MovingTheMeanKeepsTheInformationVector) {
  const DenseBelief before = oracle::dense(state);
  state.move_robot({0.1, -0.2, 0.05});
  for (int slot = 0; slot < state.landmark_count(); ++slot) state.move_landmark(slot, {0.01 * slot, -0.3});
  const DenseBelief after = oracle::dense(state);
  EXPECT_EQ(after.H, before.H);
  EXPECT_LT(relative(after.b, before.b), 1e-12);
}

TEST_P(SeifSteps, MarginalsAreBlocksOfTheDenseInverse) {
  const Eigen::MatrixXd Sigma = oracle::inverse(oracle::symmetric(full_Omega(state)));
  std::vector<LandmarkId> landmarks;
  for (int slot = 0; slot < state.landmark_count(); ++slot) landmarks.push_back(state.id(slot));
  const auto marginals = marginals_of(state, landmarks);
  ASSERT_TRUE(marginals);
  EXPECT_LT(relative(marginals->pose, Sigma.topLeftCorner<3, 3>()), 1e-9);
  for (int slot = 0; slot < state.landmark_count(); ++slot) {
    const int row = InformationState::row_of(slot);
    EXPECT_LT(relative(marginals->landmarks[static_cast<std::size_t>(slot)], Sigma.block<2, 2>(row, row)),
              1e-9);
  }
}

TEST_P(SeifSteps, MarginalsOfAFewLandmarksAreThoseOfAll) {
  std::vector<LandmarkId> landmarks;
  for (int slot = 0; slot < state.landmark_count(); ++slot) landmarks.push_back(state.id(slot));
  const auto all = marginals_of(state, landmarks);
  ASSERT_TRUE(all);
  for (std::size_t few = 0; few < landmarks.size(); ++few) {  // the last ones, in reverse
    const std::vector<LandmarkId> asked_for(landmarks.rbegin(),
                                            landmarks.rbegin() + static_cast<std::ptrdiff_t>(few));
    const auto some = marginals_of(state, asked_for);
    ASSERT_TRUE(some);
    EXPECT_LT(relative(some->pose, all->pose), 1e-9);
    ASSERT_EQ(some->landmarks.size(), few);
    for (std::size_t i = 0; i < few; ++i) {
      EXPECT_LT(relative(some->landmarks[i], all->landmarks[landmarks.size() - 1 - i]), 1e-9);
    }
  }
}

TEST_P(SeifSteps, MarginalsOfAFewLandmarksAreNothingWhereOmegaIsIndefinite) {
  state.Omega()(0, 0) = -1.0;
  const std::vector<LandmarkId> one{state.id(0)};
  EXPECT_FALSE(marginals_of(state, one));
}

TEST_P(SeifSteps, LinkCountIsThatOfTheDenseMatrix) {
  const Eigen::MatrixXd H = oracle::symmetric(full_Omega(state));
  int links = 0;
  for (int i = 0; i < state.landmark_count(); ++i) {
    const int row = InformationState::row_of(i);
    if (!H.block(row, 0, 2, 3).isZero(0.0)) ++links;
    for (int j = 0; j < i; ++j) {
      if (!H.block(row, InformationState::row_of(j), 2, 2).isZero(0.0)) ++links;
    }
  }
  EXPECT_EQ(state.link_count(), links);
}

TEST(SeifSteps, StaysSymmetricAndPositiveDefiniteOverManyUpdates) {
  RandomDrive random(7);
  InformationState state(start);
  drive(state, random, 2000);
  EXPECT_LT(relative(state.Omega().transpose(), state.Omega()), 1e-14);
  EXPECT_EQ(oracle::symmetric(full_Omega(state)).llt().info(), Eigen::Success);
  EXPECT_LE(state.active_count(), 5);
}

TEST(InformationState, RefusesAStartThatIsKnownPerfectly) {
  EXPECT_THROW(InformationState(PoseEstimate{}), std::invalid_argument);
}

}  // namespace
}  // namespace seif
