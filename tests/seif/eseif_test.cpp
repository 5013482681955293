#include "seif/eseif.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cstdint>

#include "dense_oracle.hpp"
#include "ring_drive.hpp"
#include "seif/dense/eif.hpp"
#include "seif/full_state.hpp"

namespace seif {
namespace {

using test::RingDrive;

TEST(Eseif, EqualsTheDenseInformationFilterUntilItRelocates) {
  RingDrive drive_sparse(40, 1);
  RingDrive drive_dense(40, 1);
  Eseif sparse(drive_sparse.setup(), {.theta_x = 1000});
  Eif dense(drive_dense.setup());
  for (int k = 0; k < 100; ++k) {
    drive_sparse.step(sparse);
    drive_dense.step(dense);
  }
  EXPECT_EQ(sparse.counts().relocations, 0);
  EXPECT_LT((full_mu(sparse.state()) - dense.mu()).norm(), 1e-8);
}

TEST(Eseif, BoundsTheLinksOfTheRobotAndIsExactlySparse) {
  RingDrive drive(60, 2);
  Eseif filter(drive.setup(), {.theta_x = 12, .relocation_landmarks = 4});
  for (int k = 0; k < 300; ++k) drive.step(filter);
  const Counts counts = filter.counts();
  EXPECT_GT(counts.relocations, 10);
  EXPECT_LT(counts.relocations, 300);
  EXPECT_LE(counts.active_landmarks, 12);
  const Eigen::MatrixXd Omega = oracle::symmetric(full_Omega(filter.state()));
  EXPECT_EQ(Omega.llt().info(), Eigen::Success);
  const std::int64_t all_links = 60 * 61 / 2;
  EXPECT_LT(counts.links, all_links / 2);
}

TEST(Eseif, NeverClaimsToKnowMoreThanTheDenseFilter) {
  // The filter discards odometry and approximates nothing. So its belief is wider in every direction, apart
  // from the effect of different linearisation points.
  RingDrive drive_sparse(40, 3);
  RingDrive drive_dense(40, 3);
  Eseif sparse(drive_sparse.setup(), {});
  Eif dense(drive_dense.setup());
  for (int k = 0; k < 200; ++k) {
    drive_sparse.step(sparse);
    drive_dense.step(dense);
  }
  ASSERT_GT(sparse.counts().relocations, 0);
  const Eigen::MatrixXd Sigma_sparse = oracle::inverse(oracle::symmetric(full_Omega(sparse.state())));
  const Eigen::MatrixXd Sigma_dense = oracle::inverse(dense.Omega());
  // The smallest ratio of the two variances over all directions: Sigma_sparse v = lambda Sigma_dense v.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ratio(Sigma_sparse, Sigma_dense);
  EXPECT_GT(ratio.eigenvalues().minCoeff(), 0.95);
  EXPECT_GT(Sigma_sparse.trace(), Sigma_dense.trace());
}

TEST(Eseif, TakesAScanOfNewLandmarksOnlyWithoutRelocating) {
  RingDrive drive(60, 4);
  Eseif filter(drive.setup(), {.theta_x = 3});
  drive.step(filter);
  EXPECT_EQ(filter.counts().relocations, 0);
  EXPECT_GT(filter.counts().active_landmarks, 3);
}

constexpr double relocates_at = 6.0;  // [s] time of the first relocation in this drive

/// log det of the information after the first scan that relocates. The observation `repeated`, if there is one,
/// is twice in that scan.
double information_after_relocation(int repeated) {
  RingDrive drive(60, 2);
  Eseif filter(drive.setup(), {.theta_x = 12, .relocation_landmarks = 4});
  while (filter.counts().relocations == 0) {
    drive.advance();
    filter.motion_update(drive.odometry());
    Scan scan = drive.scan();
    if (repeated >= 0 && drive.scan().t == relocates_at) {
      scan.observations.push_back(scan.observations[static_cast<std::size_t>(repeated)]);
    }
    filter.measurement_update(scan, test::ignore);
  }
  EXPECT_EQ(drive.scan().t, relocates_at);
  return oracle::symmetric(full_Omega(filter.state())).llt().matrixLLT().diagonal().array().log().sum();
}

TEST(Eseif, UsesBothObservationsOfALandmarkSeenTwiceAlsoIfOneIsHeldBack) {
  const double once = information_after_relocation(-1);
  for (int repeated = 0; repeated < 8; ++repeated) {
    EXPECT_GT(information_after_relocation(repeated), once + 0.01) << "observation " << repeated;
  }
}

}  // namespace
}  // namespace seif
