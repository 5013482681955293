// The start's uncertainty, split into what the filter holds and what is added to its covariances.
#include "seif/start_frame.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "ring_drive.hpp"
#include "seif/seif.hpp"

namespace seif {
namespace {

PoseEstimate start_with(double x_sd, double y_sd, double theta_sd, double correlation) {
  const Eigen::Vector3d sd(x_sd, y_sd, theta_sd);
  Eigen::Matrix3d C = Eigen::Matrix3d::Constant(correlation);
  C.diagonal().setOnes();
  return {{.x = 2.0, .y = -1.0, .theta = 0.3}, sd.asDiagonal() * C * sd.asDiagonal()};
}

TEST(StartFrame, LosesNothingOfTheUncertaintyAndHoldsLittleOfIt) {
  for (const PoseEstimate& start : {start_with(0.05, 0.05, 0.01, 0.0), start_with(100.0, 1e-6, 3.0, 0.99),
                                    start_with(1e-6, 1e-6, 1e-6, 0.5)}) {
    const StartFrame frame(start);
    const Eigen::Matrix3d inner = frame.inner().covariance;
    const Eigen::Matrix3d outer = frame.of_pose(start.mean);
    EXPECT_LT((inner + outer - start.covariance).norm(), 1e-9 * start.covariance.norm());
    EXPECT_EQ(inner.llt().info(), Eigen::Success);
    EXPECT_LT(inner.diagonal().cwiseSqrt().maxCoeff(), 1.000001e-3);  // D, but for rounding
    EXPECT_GT(outer.selfadjointView<Eigen::Lower>().eigenvalues()(0), -1e-12 * outer.norm());
  }
}

TEST(StartFrame, TurnsAPointByItsDistanceFromTheStart) {
  const PoseEstimate start = start_with(0.05, 0.05, 0.01, 0.0);
  const Eigen::Matrix2d P = StartFrame(start).of_point({102.0, -1.0});
  EXPECT_NEAR(std::sqrt(P(0, 0)), 0.05, 1e-4);
  EXPECT_NEAR(P(1, 1), 0.05 * 0.05 + 1.0, 0.02);  // 0.01 rad at 100 m is 1 m, but for the inner part
}

TEST(StartFrame, AddsToAJointCovarianceWhatItAddsToItsBlocks) {
  const StartFrame frame(start_with(0.05, 0.1, 0.01, 0.5));
  Eigen::VectorXd means(7);
  means << 5.0, 6.0, 0.7, 20.0, -3.0, 1.0, 2.0;
  Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(7, 7);
  frame.add_to(joint, means);
  EXPECT_TRUE(
      (joint.topLeftCorner<3, 3>().isApprox(frame.of_pose({.x = 5.0, .y = 6.0, .theta = 0.7}), 1e-12)));
  EXPECT_TRUE((joint.block<2, 2>(3, 3).isApprox(frame.of_point({20.0, -3.0}), 1e-12)));
  EXPECT_TRUE((joint.block<2, 2>(5, 5).isApprox(frame.of_point({1.0, 2.0}), 1e-12)));
  EXPECT_EQ(joint, joint.transpose());
}

TEST(StartFrame, AMapIsTheSameHoweverUncertainItsStart) {
  test::RingDrive drive(120, 1);
  EstimatorSetup setup = drive.setup();
  setup.start.covariance = 0.01 * Eigen::Matrix3d::Identity();
  Seif sure(setup, {});
  setup.start.covariance = 9.0 * Eigen::Matrix3d::Identity();
  Seif unsure(setup, {});
  for (int i = 2 * drive.steps_for_a_round(); i > 0; --i) {
    drive.step(sure);
    unsure.motion_update(drive.odometry());
    unsure.measurement_update(drive.scan(), test::ignore);
  }
  const std::vector<LandmarkEstimate> map = sure.map();
  const std::vector<LandmarkEstimate> other = unsure.map();
  ASSERT_EQ(map.size(), 120U);
  for (std::size_t i = 0; i < map.size(); ++i) EXPECT_LT((map[i].mean - other[i].mean).norm(), 1e-3);
}

TEST(StartFrame, RefusesACovarianceThatIsNone) {
  EXPECT_THROW(StartFrame(start_with(0.05, 0.05, 0.01, -1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace seif
