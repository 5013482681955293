// Our filter as a whole: the cost of an update in a map of any size, and options at their limits.
#include "seif/seif.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdint>

#include "allocation_counter.hpp"
#include "ring_drive.hpp"

namespace seif {
namespace {

using test::RingDrive;

/// Mean number of blocks touched by an update at the end of one round, over several drives.
double blocks_touched(int landmarks, MeanRecovery mean) {
  const int drives = 4;
  const int measured = 400;
  std::int64_t blocks = 0;
  for (unsigned seed = 1; seed <= drives; ++seed) {
    RingDrive drive(landmarks, seed);
    Seif filter(drive.setup(), {.mean_recovery = mean});
    for (int k = 0; k < drive.steps_for_a_round() - measured; ++k) drive.step(filter);
    blocks -= filter.counts().blocks_touched;
    for (int k = 0; k < measured; ++k) drive.step(filter);
    blocks += filter.counts().blocks_touched;
  }
  return static_cast<double>(blocks) / (drives * measured);
}

// Not equal: the number of levels, of the tree or of groups, grows with log N, so there are a few more levels
// at 20,000 landmarks than at 1,000.
TEST(Seif, TouchesNearlyAsManyBlocksInALargeMapAsInASmallOne) {
  if (test::under_sanitizer) GTEST_SKIP() << "the counts are those of other builds, and take minutes here";
  for (const MeanRecovery mean : {MeanRecovery::tree, MeanRecovery::multilevel}) {
    EXPECT_NEAR(blocks_touched(20'000, mean) / blocks_touched(1'000, mean), 1.0, 0.15);
  }
}

/// By the tree in constant time, as the whole belief has it: also after the sparsifications of the drive.
/// With frames that turn, the zone has them where its landmarks were when it moved. The marginals have them where they
/// are now.
TEST(Seif, KnowsTheCovarianceOfItsPoseAfterAScan) {
  for (const bool turns : {false, true}) {
    RingDrive drive(60, 5);
    SeifOptions options;
    options.tree.turns = turns;
    options.tree.most_unknowns = 1'000'000;  // no groups
    Seif filter(drive.setup(), options);
    EXPECT_FALSE(filter.pose_covariance());
    for (int k = 0; k < 2 * drive.steps_for_a_round(); ++k) {
      drive.step(filter);
      const Eigen::Matrix3d P = filter.pose_covariance().value();
      const Eigen::Matrix3d expected = filter.marginal_covariances({})->pose;
      ASSERT_LT((P - expected).norm(), (turns ? 2e-2 : 1e-6) * expected.norm()) << "step " << k;
      ASSERT_EQ(P, P.transpose());
    }
    drive.advance();
    filter.motion_update(drive.odometry());
    EXPECT_FALSE(filter.pose_covariance()) << "a motion was taken in since";
  }
}

/// Tying landmarks together leaves fewer unknowns: the covariance can only become smaller, and it must not by much.
TEST(Seif, GroupsHardlyChangeTheCovarianceOfThePose) {
  RingDrive drive(60, 5);
  SeifOptions options;
  options.tree.turns = false;
  Seif filter(drive.setup(), options);
  double largest = 0.0;  // change, relative
  for (int k = 0; k < 2 * drive.steps_for_a_round(); ++k) {
    drive.step(filter);
    const Eigen::Matrix3d P = filter.pose_covariance().value();
    const Eigen::Matrix3d expected = filter.marginal_covariances({})->pose;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> smaller_by(expected - P);
    ASSERT_GT(smaller_by.eigenvalues()(0), -1e-6 * expected.norm()) << "step " << k;
    largest = std::max(largest, (P - expected).norm() / expected.norm());
  }
  EXPECT_GT(largest, 1e-7);  // otherwise there were no groups
  EXPECT_LT(largest, 1e-2);  // 0.003
}

// Holds for every mean recovery.
TEST(Seif, AllocatesNothingOnceTheMapIsBuilt) {
  if (COUNTS_ALLOCATIONS == 0) GTEST_SKIP() << "the sanitizer has a malloc of its own";
  for (const MeanRecovery mean : {MeanRecovery::tree, MeanRecovery::multilevel}) {
    RingDrive drive(300, 4);
    Seif filter(drive.setup(), {.mean_recovery = mean});
    // Several rounds, until every message of the tree has once had its largest size.
    for (int k = 0; k < 6 * drive.steps_for_a_round(); ++k) {
      drive.step(filter);
      ASSERT_EQ(filter.pose_covariance().has_value(), mean == MeanRecovery::tree);
    }
    for (int k = 0; k < drive.steps_for_a_round(); ++k) {
      drive.advance();
      const long before = allocations();
      filter.motion_update(drive.odometry());
      filter.measurement_update(drive.scan(), test::ignore);
      ASSERT_EQ(filter.pose_covariance().has_value(), mean == MeanRecovery::tree);
      ASSERT_EQ(allocations(), before) << "step " << k;
    }
  }
}

TEST(Seif, ReportsNoErrorOfTheMeanWhereTheMeanIsExact) {
  RingDrive drive(60, 5);
  Seif exact(drive.setup(), {.mean_recovery = MeanRecovery::exact});
  Seif multilevel(drive.setup(), {.mean_recovery = MeanRecovery::multilevel});
  for (int k = 0; k < drive.steps_for_a_round(); ++k) {
    drive.step(exact);
    multilevel.motion_update(drive.odometry());
    multilevel.measurement_update(drive.scan(), test::ignore);
  }
  EXPECT_FALSE(exact.counts().mean_residual);
  EXPECT_GT(multilevel.counts().mean_residual.value(), 0.0);
}

}  // namespace
}  // namespace seif
