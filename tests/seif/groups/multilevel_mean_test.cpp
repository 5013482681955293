// The mean by groups of landmarks: exact for the window, and converging to the exact solution elsewhere.
#include "seif/groups/multilevel_mean.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>
#include <vector>

#include "seif/dense_oracle.hpp"
#include "seif/driven_state.hpp"
#include "seif/full_state.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/motion_update.hpp"
#include "seif/observation_factor.hpp"
#include "seif/ring_drive.hpp"
#include "seif/seif.hpp"
#include "seif/sparsification.hpp"

namespace seif {
namespace {

using test::relative;
using test::RingDrive;

/// The filter in single steps, so that each step of the mean can be tested alone.
struct Mapper {
  explicit Mapper(const PoseEstimate& start, const MultilevelOptions& options = {})
      : state(start), mean(options) {}

  InformationState state;
  MultilevelMean mean;
  std::vector<Eigen::Vector2d> joined_at = {};  // by slot

  void activate_known(const Scan& scan) {
    for (const Observation& z : scan.observations) {
      const auto slot = state.find(z.landmark);
      if (slot && state.position(*slot) < 0) mean.activate(state, *slot);
      if (slot) state.mark_seen(*slot);
    }
    EXPECT_TRUE(mean.before_information(state));
  }

  void add_known(const Scan& scan) {
    std::vector<ObservationFactor> factors;
    for (const Observation& z : scan.observations) {
      if (const auto slot = state.find(z.landmark)) factors.push_back(linearise(state, *slot, z, {}));
    }
    for (const ObservationFactor& factor : factors) add(state, factor);
  }

  void add_new(const Scan& scan, bool heard = true) {
    for (const Observation& z : scan.observations) {
      if (state.find(z.landmark)) continue;
      joined_at.push_back(invert_observation(state.pose(), {}, z).p_world_landmark);
      const int slot = state.add_landmark(z.landmark, joined_at.back());
      mean.join(state, slot);
      state.mark_seen(slot);
      add(state, linearise(state, slot, z, {}));
    }
    if (heard) {
      EXPECT_TRUE(mean.after_information(state));
    }
  }

  /// Sparsifies down to `theta_x` links if the robot has more than `theta_max`.
  void sparsify(int theta_x, int theta_max) {
    if (state.active_count() <= theta_max) return;
    std::vector<int> dropped;
    choose_to_drop(state, DropOrder::least_recently_seen, state.active_count() - theta_x, dropped);
    ASSERT_TRUE(seif::sparsify(state, SparsificationRule::gauge_free, dropped));
  }

  void update(const Odometry& odometry, const Scan& scan, int theta_x = 12, int theta_max = 16) {
    motion_update(state, odometry);
    state.begin_scan();
    activate_known(scan);
    add_known(scan);
    ASSERT_TRUE(mean.solve_window(state));
    add_new(scan);
    sparsify(theta_x, theta_max);
    ASSERT_TRUE(mean.correct(state));
  }

  /// The mean with all waiting motions applied (3+2N x 1).
  Eigen::VectorXd mu() const {
    Eigen::VectorXd mu = full_mu(state);
    for (int slot = 0; slot < state.landmark_count(); ++slot) {
      mu.segment<2>(InformationState::row_of(slot)) = mean.mean(state, slot);
    }
    return mu;
  }

  Eigen::MatrixXd Omega() const { return oracle::symmetric(full_Omega(state)); }
  Eigen::VectorXd xi() const { return oracle::dense(state).b; }
  Eigen::VectorXd r() const { return xi() - Omega() * mu(); }  // at that mean

  /// The columns of the identity for the window, in its own order (n x w).
  Eigen::MatrixXd window() const {
    std::vector<int> slots;
    for (int p = 0; p < state.active_count(); ++p) slots.push_back(state.active(p));
    return oracle::projection(InformationState::row_of(state.landmark_count()), true, slots);
  }

  /// r' Omega^-1 r: the squared error of the mean in units of sigma.
  double squared_error() const {
    const Eigen::VectorXd residual = r();
    return residual.dot(oracle::solve(Omega(), residual));
  }
};

constexpr double rounding = 1e-9;  // [m, rad], or relative

/// In the second round, just after the ring has closed: everywhere motions wait to be applied.
class AfterClosure : public testing::Test {
 protected:
  void SetUp() override {
    for (int k = 0; k < drive.steps_for_a_round() + 5; ++k) {
      drive.advance();
      mapper.update(drive.odometry(), drive.scan());
    }
    ASSERT_GT((mapper.mu() - full_mu(mapper.state)).norm(), 1e-4);
  }

  RingDrive drive{160, 3};
  Mapper mapper{drive.setup().start};
};

TEST_F(AfterClosure, MotionsAndStepsKeepTheInformationVector) {
  for (int k = 0; k < 30; ++k) {
    const Eigen::VectorXd xi = mapper.xi();
    ASSERT_TRUE(mapper.mean.correct(mapper.state));
    ASSERT_LT(relative(mapper.xi(), xi), rounding);
  }
}

TEST_F(AfterClosure, ActivationAndJoiningMoveNoMean) {
  int activated = 0;
  for (int k = 0; k < 60; ++k) {
    drive.advance();
    motion_update(mapper.state, drive.odometry());
    mapper.state.begin_scan();
    const Eigen::VectorXd mu = mapper.mu();
    const Eigen::VectorXd r = mapper.r();
    const int active = mapper.state.active_count();
    mapper.activate_known(drive.scan());
    activated += mapper.state.active_count() - active;
    ASSERT_LT((mapper.mu() - mu).norm(), rounding);
    ASSERT_LT((mapper.r() - r).norm(), rounding * mapper.xi().norm());
    mapper.add_known(drive.scan());
    ASSERT_TRUE(mapper.mean.solve_window(mapper.state));
    mapper.add_new(drive.scan());
    mapper.sparsify(12, 16);
    ASSERT_TRUE(mapper.mean.correct(mapper.state));
  }
  EXPECT_GT(activated, 20);
  const Eigen::VectorXd mu = mapper.mu();
  const Eigen::VectorXd r = mapper.r();
  const int slot = mapper.state.add_landmark(1000, {3.0, -2.0});
  mapper.mean.join(mapper.state, slot);
  EXPECT_LT((mapper.mu().head(mu.size()) - mu).norm(), rounding);
  EXPECT_LT((mapper.mu().tail<2>() - Eigen::Vector2d(3.0, -2.0)).norm(), rounding);
  EXPECT_LT((mapper.r().head(mu.size()) - r).norm(), rounding * mapper.xi().norm());
}

TEST_F(AfterClosure, SolvingForTheWindowIsTheDenseSolutionOfItsBlock) {
  for (int k = 0; k < 20; ++k) {
    drive.advance();
    motion_update(mapper.state, drive.odometry());
    mapper.state.begin_scan();
    mapper.activate_known(drive.scan());
    mapper.add_known(drive.scan());
    const Eigen::MatrixXd S = mapper.window();
    const Eigen::MatrixXd Omega = mapper.Omega();
    const Eigen::VectorXd step = oracle::solve(S.transpose() * Omega * S, S.transpose() * mapper.r());
    const Eigen::VectorXd expected = mapper.mu() + S * step;
    ASSERT_GT(step.norm(), 1e-5);
    ASSERT_TRUE(mapper.mean.solve_window(mapper.state));
    ASSERT_LT((mapper.mu() - expected).norm(), rounding);
    mapper.add_new(drive.scan());
    mapper.sparsify(12, 16);
    ASSERT_TRUE(mapper.mean.correct(mapper.state));
    ASSERT_LT((mapper.window().transpose() * mapper.r()).norm(), rounding * mapper.xi().norm());
  }
}

// Each motion and each relaxation minimises the error over a few directions, or goes at most that far beyond
// the minimum. So none of them can increase the error in the norm of Omega, if the groups' forces are right.
TEST_F(AfterClosure, ARobotAtRestComesToTheExactMean) {
  const Odometry at_rest;
  const double first = mapper.squared_error();
  EXPECT_GT(first, 1.0);
  double last = first;
  for (int k = 0; k < 100; ++k) {
    mapper.update(at_rest, {});
    const double now = mapper.squared_error();
    ASSERT_LE(now, last * (1 + rounding)) << "update " << k;
    last = now;
  }
  EXPECT_LT(last, 0.01 * first);
}

// A level is added above groups that have already moved.
TEST_F(AfterClosure, TheMapMayGrowByALevel) {
  const Odometry at_rest;
  for (int k = 0; k < 20; ++k) {  // ten landmarks at a time, far from the ten before
    Scan scan;
    for (int i = 0; i < 10; ++i) {
      Observation z{.landmark = 1000 + 10 * k + i, .range = 20.0 + 3.0 * k + i, .bearing = 0.3 * i};
      z.covariance.diagonal() << 4e-4, 1e-4;
      scan.observations.push_back(z);
    }
    mapper.update(at_rest, scan);
  }
  double last = mapper.squared_error();
  for (int k = 0; k < (test::under_sanitizer ? 10 : 30); ++k) {
    mapper.update(at_rest, {});
    const double now = mapper.squared_error();
    ASSERT_LE(now, last * (1 + rounding)) << "update " << k;
    last = now;
  }
}

/// A small room, in which the robot sees three landmarks at a time, chosen at random.
Mapper in_room(int landmarks, const MultilevelOptions& options, int updates) {
  oracle::RandomDrive random(11);
  Mapper mapper(test::start, options);
  Pose2 truth = test::start.mean;
  for (int k = 0; k < updates; ++k) {
    const Odometry u = random.odometry();
    truth = truth * u.T_previous_current;
    Scan scan;
    for (int i = 0; i < std::min(3, landmarks); ++i) {
      const int landmark = static_cast<int>(random.uniform(0, landmarks));
      scan.observations.push_back(
          random.observation(landmark, truth, {1.0 + landmark % 5, -2.0 + 0.7 * landmark}));
    }
    mapper.update(u, scan, 3, 5);
  }
  return mapper;
}

// With one group, and no landmark relaxed alone, nothing moves after the last step of the group. Then the
// residual is exactly that group's part of the error, and a lower bound without any factor.
TEST(MultilevelMean, TheResidualOfASingleGroupIsThatOfTheDenseMatrices) {
  Mapper mapper = in_room(10, {.over_correction = 0.0, .other_groups = 0, .relaxed_groups = 0}, 60);
  ASSERT_EQ(mapper.state.landmark_count(), 10);
  ASSERT_TRUE(mapper.mean.correct(mapper.state));
  const Eigen::MatrixXd Omega = mapper.Omega();
  const auto n = Omega.rows() - 3;
  const Eigen::MatrixXd D = Omega.bottomRightCorner(n, n) - Omega.bottomLeftCorner(n, 3) *
                                                                Omega.topLeftCorner<3, 3>().inverse() *
                                                                Omega.topRightCorner(3, n);
  Eigen::MatrixXd B(n, 3);  // about the group's first landmark; positions as the landmarks joined
  for (int slot = 0; slot < mapper.state.landmark_count(); ++slot) {
    const Eigen::Vector2d lever = mapper.joined_at[static_cast<std::size_t>(slot)] - mapper.joined_at[0];
    B.middleRows<2>(2 * slot) << 1, 0, -lever.y(), 0, 1, lever.x();
  }
  const Eigen::Vector3d R = B.transpose() * mapper.r().tail(n);
  const double expected = R.dot(oracle::solve(B.transpose() * D * B, R));
  EXPECT_GT(expected, 1e-6);
  EXPECT_NEAR(mapper.mean.residual(), expected, 1e-6 * expected);
  EXPECT_LE(mapper.mean.residual(), mapper.squared_error());
}

/// A robot that drives around so few landmarks that all are always in its window.
void expect_exact_mean(int landmarks) {
  oracle::RandomDrive random(5);
  const EstimatorSetup setup{.start = test::start, .T_robot_sensor = {}, .random = std::mt19937_64(1)};
  Seif multilevel(setup, {.mean_recovery = MeanRecovery::multilevel});
  Seif exact(setup, {.mean_recovery = MeanRecovery::exact});
  Pose2 truth = test::start.mean;
  for (int k = 0; k < 100; ++k) {
    const Odometry u = random.odometry();
    truth = truth * u.T_previous_current;
    Scan scan;
    for (int i = 0; k >= 3 && i < landmarks; ++i) {  // three empty scans at first
      scan.observations.push_back(random.observation(i, truth, {2.0 + i, 1.0}));
    }
    for (Seif* filter : {&multilevel, &exact}) {
      filter->motion_update(u);
      filter->measurement_update(scan, test::ignore);
    }
    ASSERT_LT((full_mu(multilevel.state()) - full_mu(exact.state())).norm(), rounding);
  }
  EXPECT_EQ(multilevel.map().size(), static_cast<std::size_t>(landmarks));
}

TEST(MultilevelMean, OfAMapOfOneLandmarkIsExact) { expect_exact_mean(1); }

TEST(MultilevelMean, OfAMapOfTwoLandmarksIsExact) { expect_exact_mean(2); }

TEST(MultilevelMean, IsTheSameToTheBitTheSecondTime) {
  RingDrive drive_a(120, 9);
  RingDrive drive_b(120, 9);
  Seif a(drive_a.setup(), {.mean_recovery = MeanRecovery::multilevel});
  Seif b(drive_b.setup(), {.mean_recovery = MeanRecovery::multilevel});
  for (int k = 0; k < 2 * drive_a.steps_for_a_round(); ++k) {
    drive_a.step(a);
    drive_b.step(b);
    ASSERT_EQ(a.pose().x, b.pose().x);
    ASSERT_EQ(a.counts().mean_residual.value(), b.counts().mean_residual.value());
  }
  const std::vector<LandmarkEstimate> map_a = a.map();
  const std::vector<LandmarkEstimate> map_b = b.map();
  ASSERT_EQ(map_a.size(), map_b.size());
  for (std::size_t i = 0; i < map_a.size(); ++i) EXPECT_EQ(map_a[i].mean, map_b[i].mean);
}

}  // namespace
}  // namespace seif
