// The motion update as printed in the report and in the book. Where a printed equation is right, it gives our
// result; where it is wrong, the test shows by how much. U, the report's motion noise, has full rank here
// unless a test says otherwise.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "dense_oracle.hpp"
#include "driven_state.hpp"
#include "seif/full_state.hpp"
#include "seif/information_state.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/motion_update.hpp"

namespace seif {
namespace {

using oracle::DenseBelief;
using oracle::RandomDrive;
using test::relative;

constexpr double formula_rounding = 1e-12;  // relative
constexpr double inverses = 1e-8;           // relative, where a matrix is inverted on the way
constexpr double visible = 1e-3;            // relative; a larger difference is not rounding

/// A covariance of full rank, so well conditioned that its inverse loses no digits.
Eigen::Matrix3d any_covariance(RandomDrive& random) {
  const auto any = [&] { return random.uniform(-0.03, 0.03); };
  const Eigen::Matrix3d L = Eigen::Matrix3d::NullaryExpr(any);
  return L * L.transpose() + 4e-4 * Eigen::Matrix3d::Identity();
}

/// A turn on the spot: the only planar motion with A = 0.
Odometry turn_on_the_spot(RandomDrive& random) {
  Odometry u;
  u.T_previous_current.theta = random.uniform(0.1, 0.4);
  u.covariance = any_covariance(random);
  return u;
}

Odometry drive_on(RandomDrive& random) {
  Odometry u = random.odometry();
  u.covariance = any_covariance(random);
  return u;
}

/// The report's S_x (n x 3).
Eigen::MatrixXd S_x(const DenseBelief& belief) { return oracle::projection(belief.H.rows(), true, {}); }

/// The report's mu_hat: what the motion adds to the mean (n x 1).
Eigen::VectorXd mu_hat(const DenseBelief& belief, const Odometry& u) {
  const Pose2 from = oracle::pose_of(belief);
  const Pose2 to = predict_pose(from, u).pose;
  Eigen::VectorXd added = Eigen::VectorXd::Zero(belief.mu.size());
  added.head<3>() << to.x - from.x, to.y - from.y, to.theta - from.theta;
  return added;
}

/// U in the world frame, in which (26) adds it (3 x 3).
Eigen::Matrix3d U(const DenseBelief& belief, const Odometry& u) {
  const Eigen::Matrix3d L = predict_pose(oracle::pose_of(belief), u).noise_factor;
  return L * L.transpose();
}

enum class LastTerm { as_printed = +1, mended = -1 };

/// Lemma 2, (35) = (57): L = S_x [U^-1 + S_x' H S_x]^-1 S_x' H, H_bar = H - H L,
/// b_bar = b + mu_hat' H - b L +- mu_hat' H L. With (34), b_bar = (mu + mu_hat)' H_bar: the sign is minus.
DenseBelief lemma_2(const DenseBelief& belief, const Eigen::VectorXd& added, const Eigen::Matrix3d& noise,
                    LastTerm last_term) {
  const Eigen::MatrixXd S = S_x(belief);
  const Eigen::MatrixXd& H = belief.H;
  const Eigen::MatrixXd L = S * (noise.inverse() + S.transpose() * H * S).inverse() * S.transpose() * H;
  const Eigen::VectorXd H_added = H * added;
  return {.H = H - H * L,
          .b = belief.b + H_added - L.transpose() * belief.b +
               static_cast<double>(last_term) * L.transpose() * H_added,
          .mu = belief.mu + added};
}

/// The linear motion mu + mu_hat with noise U, through the covariance: (31), (32).
DenseBelief by_covariance(const DenseBelief& belief, const Eigen::VectorXd& added,
                          const Eigen::Matrix3d& noise) {
  const Eigen::MatrixXd S = S_x(belief);
  const Eigen::MatrixXd Sigma = oracle::inverse(belief.H);
  const Eigen::MatrixXd H_bar = oracle::inverse(Sigma + S * noise * S.transpose());
  return {.H = H_bar, .b = H_bar * (Sigma * belief.b + added), .mu = belief.mu + added};
}

class Report : public testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override {
    test::drive(state, random, 25);
    state.move_robot({0.02, -0.01, 0.005});  // otherwise r_x = 0, and some wrong equations for b would pass
  }

  RandomDrive random{GetParam()};
  InformationState state{test::start};
};

INSTANTIATE_TEST_SUITE_P(Seeds, Report, testing::Values(1U, 2U, 3U, 4U, 5U));

TEST_P(Report, Equation35HasTheSignOfItsLastTermWrong) {
  const DenseBelief before = oracle::dense(state);
  Eigen::VectorXd added = Eigen::VectorXd::Zero(before.mu.size());
  added.head<3>() << 0.4, -0.3, 0.2;  // linear motion: any displacement has A = 0
  const Eigen::Matrix3d noise = any_covariance(random);
  const DenseBelief expected = by_covariance(before, added, noise);
  const DenseBelief mended = lemma_2(before, added, noise, LastTerm::mended);
  EXPECT_LT(relative(mended.H, expected.H), formula_rounding);
  EXPECT_LT(relative(mended.b, expected.b), formula_rounding);
  EXPECT_GT(relative(lemma_2(before, added, noise, LastTerm::as_printed).b, expected.b), visible);
}

TEST_P(Report, Lemma2EqualsOurMotionUpdateForATurnOnTheSpot) {
  const DenseBelief before = oracle::dense(state);
  const Odometry u = turn_on_the_spot(random);
  ASSERT_EQ(predict_pose(state.pose(), u).J_wrt_pose, Eigen::Matrix3d::Identity());  // A = 0
  const DenseBelief by_lemma = lemma_2(before, mu_hat(before, u), U(before, u), LastTerm::mended);
  motion_update(state, u);
  const DenseBelief ours = oracle::dense(state);
  EXPECT_LT(relative(ours.H, by_lemma.H), formula_rounding);
  EXPECT_LT(relative(ours.b, by_lemma.b), formula_rounding);
  EXPECT_LT(relative(ours.mu, by_lemma.mu), formula_rounding);
}

TEST_P(Report, Lemma2ChangesTheBlocksOfRobotAndActiveLandmarksAlone) {
  const DenseBelief before = oracle::dense(state);
  ASSERT_LT(state.active_count(), state.landmark_count());
  const Odometry u = turn_on_the_spot(random);
  const DenseBelief by_lemma = lemma_2(before, mu_hat(before, u), U(before, u), LastTerm::mended);
  motion_update(state, u);
  const DenseBelief ours = oracle::dense(state);
  for (int i = 0; i < state.landmark_count(); ++i) {
    const int row = InformationState::row_of(i);
    for (int j = 0; j < state.landmark_count(); ++j) {
      const int col = InformationState::row_of(j);
      const bool both_active = state.position(i) >= 0 && state.position(j) >= 0;
      const Eigen::Matrix2d old = before.H.block<2, 2>(row, col);
      EXPECT_EQ(ours.H.block(row, col, 2, 2) != old, both_active) << i << ' ' << j;
      EXPECT_EQ(by_lemma.H.block(row, col, 2, 2) != old, both_active) << i << ' ' << j;
    }
    EXPECT_EQ(by_lemma.b.segment(row, 2) != before.b.segment(row, 2), state.position(i) >= 0) << i;
  }
}

TEST_P(Report, Equation36HasTheSignOfTheInformationVectorWrong) {
  ASSERT_TRUE(solve_mean(state));  // r = 0: both sides use the same mean
  const DenseBelief before = oracle::dense(state);
  const Odometry u = random.odometry();
  const PredictedPose predicted = predict_pose(state.pose(), u);
  Eigen::MatrixXd Psi = Eigen::MatrixXd::Identity(before.H.rows(), before.H.cols());
  Psi.topLeftCorner<3, 3>() = predicted.J_wrt_pose.inverse();
  const Eigen::MatrixXd H_prime = Psi.transpose() * before.H * Psi;
  DenseBelief after = before;
  oracle::motion_update(after, u);
  const Eigen::MatrixXd dH = H_prime - after.H;
  const Eigen::VectorXd moved_by_motion = after.H * (after.mu - before.mu);
  const Eigen::VectorXd as_printed = before.b - (dH - before.H + H_prime) * before.mu + moved_by_motion;
  const Eigen::VectorXd mended = before.b - (dH + before.H - H_prime) * before.mu + moved_by_motion;
  EXPECT_LT(relative(mended, after.b), inverses);
  EXPECT_GT(relative(as_printed, after.b), visible);
}

TEST_P(Report, Equation36WithItsSignMendedLeavesTheResidualWhereTheRobotHasNone) {
  ASSERT_TRUE(coordinate_descent(state, 0, random.random));  // afterwards r_x = 0
  const Eigen::VectorXd r = full_r(state);
  ASSERT_LT(r.head<3>().norm(), 1e-9);
  ASSERT_GT(r.norm(), 1e-3);
  motion_update(state, random.odometry());
  EXPECT_LT((full_r(state) - r).norm(), 1e-9);
}

TEST_P(Report, Lemma3InvertsAMatrixThatIsSingularForEveryMotionOfThePlane) {
  for (int k = 0; k < 20; ++k) {
    const Odometry u = random.odometry();
    const Eigen::Matrix3d A = predict_pose(state.pose(), u).J_wrt_pose - Eigen::Matrix3d::Identity();
    EXPECT_EQ(A.determinant(), 0.0);  // S_x' A S_x is zero except for its last column
    EXPECT_EQ(A.fullPivLu().rank(), 1);
    EXPECT_FALSE(((Eigen::Matrix3d::Identity() + A.inverse()).inverse()).allFinite());  // as (36) has it
    EXPECT_EQ((A * A).norm(), 0.0);  // so Psi = (I + A)^-1 = I - A still exists
  }
  // For a regular A the lemma is right.
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d A = 10.0 * any_covariance(random) + I;
  EXPECT_LT(relative(I - (I + A.inverse()).inverse(), (I + A).inverse()), formula_rounding);
}

/// SEIF_motion_update of Probabilistic Robotics, (12.12)-(12.15), with F_x the report's S_x'.
DenseBelief book_motion_update(const DenseBelief& belief, const Odometry& u) {
  const Eigen::MatrixXd F_x = S_x(belief).transpose();
  const Eigen::MatrixXd& Omega = belief.H;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d Delta = predict_pose(oracle::pose_of(belief), u).J_wrt_pose - I;
  const Eigen::VectorXd delta = F_x * mu_hat(belief, u);
  const Eigen::Matrix3d R = U(belief, u);

  const Eigen::MatrixXd Psi = F_x.transpose() * ((I + Delta).inverse() - I) * F_x;
  const Eigen::MatrixXd lambda = Psi.transpose() * Omega + Omega * Psi + Psi.transpose() * Omega * Psi;
  const Eigen::MatrixXd Phi = Omega + lambda;
  const Eigen::MatrixXd kappa =
      Phi * F_x.transpose() * (R.inverse() + F_x * Phi * F_x.transpose()).inverse() * F_x * Phi;
  const Eigen::MatrixXd Omega_bar = Phi - kappa;
  return {.H = Omega_bar,
          .b = belief.b + (lambda - kappa) * belief.mu + Omega_bar * F_x.transpose() * delta,
          .mu = belief.mu + F_x.transpose() * delta};
}

TEST_P(Report, TheBooksMotionUpdateEqualsOurs) {
  ASSERT_TRUE(solve_mean(state));  // (12.15) takes mu for Omega^-1 xi
  for (int k = 0; k < 3; ++k) {
    const Odometry u = drive_on(random);
    const DenseBelief by_book = book_motion_update(oracle::dense(state), u);
    motion_update(state, u);
    const DenseBelief ours = oracle::dense(state);
    EXPECT_LT(relative(ours.H, by_book.H), formula_rounding);
    EXPECT_LT(relative(ours.b, by_book.b), formula_rounding);
    EXPECT_LT(relative(ours.mu, by_book.mu), formula_rounding);
  }
}

TEST_P(Report, TheInverseOfUDoesNotExistForADifferentialDriveNorAtRestAndOursNeedsNone) {
  Odometry rank_2 = random.odometry();
  rank_2.covariance << 4e-4, 0, 2e-4, 0, 0, 0, 2e-4, 0, 1e-4 + 1e-5;  // no sideways slip: zero to the bit
  Odometry rank_0 = random.odometry();
  rank_0.covariance.setZero();
  for (const Odometry& u : {rank_2, rank_0}) {
    DenseBelief belief = oracle::dense(state);
    EXPECT_FALSE(Eigen::Matrix3d(u.covariance.inverse()).allFinite());
    oracle::motion_update(belief, u);
    motion_update(state, u);
    const DenseBelief ours = oracle::dense(state);
    EXPECT_LT(relative(ours.H, belief.H), inverses);
    EXPECT_LT(relative(ours.b, belief.b), inverses);
  }
}

}  // namespace
}  // namespace seif
