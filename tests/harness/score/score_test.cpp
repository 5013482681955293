#include "harness/score/score.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "harness/statistics/alignment.hpp"

namespace harness {
namespace {

using std::numbers::pi;
constexpr double score_rounding = 1e-12;

TEST(Alignment, FindsTheMotionThatWasApplied) {
  const seif::Pose2 T_to_from{3.0, -2.0, 2.5};
  const std::vector<Eigen::Vector2d> from = {{0, 0}, {1, 0}, {4, 7}, {-2, 3}};
  std::vector<Eigen::Vector2d> to;
  for (const Eigen::Vector2d& p : from) to.push_back(T_to_from * p);
  const std::optional<seif::Pose2> found = align(from, to);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, 3.0, score_rounding);
  EXPECT_NEAR(found->y, -2.0, score_rounding);
  EXPECT_NEAR(found->theta, 2.5, score_rounding);
}

TEST(Alignment, PointsWithoutADirectionFixNoRotation) {
  const std::vector<Eigen::Vector2d> one = {{0.1, 0.2}};
  const std::vector<Eigen::Vector2d> same = {{0.1, 0.2}, {0.1, 0.2}, {0.1, 0.2}};
  const std::vector<Eigen::Vector2d> apart = {{0.1, 0.2}, {1.0, 0.2}, {0.1, 3.0}};
  EXPECT_FALSE(align({}, {}));
  EXPECT_FALSE(align(one, one));
  EXPECT_FALSE(align(same, apart));
}

TEST(Alignment, NeverMirrors) {
  // A mirror image would fit exactly. The best rotation is zero, and leaves errors of 2 m at two of four
  // points.
  const std::vector<PointPair> points = {
      {{2, 0}, {2, 0}}, {{0, 1}, {0, -1}}, {{-2, 0}, {-2, 0}}, {{0, -1}, {0, 1}}};
  EXPECT_NEAR(*score_points(points).rmse_aligned, std::sqrt(2.0), score_rounding);
}

/// Two points, estimated 1 m too far apart: after alignment, only half a metre at each end remains.
TEST(ScorePoints, MatchesTheHandComputedCase) {
  const std::vector<PointPair> points = {{{10, 5}, {0, 0}}, {{10, 8}, {2, 0}}};
  const PointScore score = score_points(points);
  EXPECT_NEAR(*score.rmse, std::sqrt((125.0 + 128.0) / 2.0), score_rounding);
  EXPECT_NEAR(*score.rmse_aligned, 0.5, score_rounding);
  EXPECT_FALSE(score_points({}).rmse);
}

/// Drives along x at 1 m/s; the estimate drifts sideways by 0.1 m per second.
std::vector<PosePair> drifting() {
  std::vector<PosePair> poses;
  for (int i = 0; i <= 10; ++i) poses.push_back({0.1 * i, {0.1 * i, 0.01 * i, 0.0}, {0.1 * i, 0.0, 0.0}});
  return poses;
}

TEST(AbsoluteTrajectoryError, MatchesTheHandComputedCase) {
  // sum of (0.01 i)^2 over 0..10 is 385e-4.
  EXPECT_NEAR(*absolute_trajectory_error(drifting()).rmse, std::sqrt(385e-4 / 11.0), score_rounding);
  // A straight line, turned by atan(0.1) and longer by 1/cos: after alignment 0.1 (sqrt(1.01) - 1) |i - 5| is
  // left.
  const double left = 0.1 * (std::sqrt(1.01) - 1.0) * std::sqrt(10.0);
  EXPECT_NEAR(*absolute_trajectory_error(drifting()).rmse_aligned, left, score_rounding);
}

TEST(RelativePoseError, MatchesTheHandComputedCase) {
  const RelativePoseError error = relative_pose_error(drifting(), 0.5);
  EXPECT_NEAR(*error.translation, 0.05, score_rounding);
  EXPECT_NEAR(*error.rotation, 0.0, score_rounding);
}

TEST(RelativePoseError, IsMeasuredInTheFrameOfTheRobot) {
  // The truth is 1 m straight ahead; the estimate turns by 0.2 afterwards. The global headings do not matter.
  const std::vector<PosePair> poses = {
      {0.0, {7, 7, 1.0}, {0, 0, pi / 2}},
      {1.0, seif::Pose2{7, 7, 1.0} * seif::Pose2{1, 0, 0.2}, {0, 1, pi / 2}}};
  const RelativePoseError error = relative_pose_error(poses, 1.0);
  EXPECT_NEAR(*error.translation, 0.0, score_rounding);
  EXPECT_NEAR(*error.rotation, 0.2, score_rounding);
}

TEST(RelativePoseError, TakesNoPairThatIsNotTheIntervalApart) {
  const std::vector<PosePair> poses = {{0.0, {}, {}}, {1.0, {}, {}}, {5.0, {}, {}}};
  EXPECT_FALSE(relative_pose_error(poses, 2.5).translation);
  EXPECT_FALSE(relative_pose_error({}, 1.0).translation);
}

TEST(PoseError, TurnsTheShortWay) {
  EXPECT_NEAR(pose_error({0, 0, pi - 0.1}, {0, 0, -pi + 0.1})(2), -0.2, score_rounding);
}

TEST(Nees, OfGaussianErrorsIsOnePerDegreeOfFreedom) {
  Eigen::Matrix3d covariance;
  covariance << 4.0, 1.0, 0.1, 1.0, 2.0, -0.2, 0.1, -0.2, 0.3;
  const Eigen::Matrix3d L = covariance.llt().matrixL();
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  constexpr int count = 20000;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d white(normal(random), normal(random), normal(random));
    sum += *nees(Eigen::Vector3d(L * white), covariance);
  }
  // A chi-square variable of 3 degrees of freedom, divided by 3, has the variance 2/3. Five standard errors of
  // the mean are allowed.
  EXPECT_NEAR(sum / count, 1.0, 5.0 * std::sqrt(2.0 / 3.0 / count));
}

TEST(Nees, MatchesTheHandComputedCase) {
  EXPECT_NEAR(*nees(Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d(1.0, 4.0).asDiagonal().toDenseMatrix()), 1.0,
              score_rounding);
}

TEST(Nees, OfAnImproperBeliefIsNothing) {
  EXPECT_FALSE(nees(Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(1.0, -1.0).asDiagonal().toDenseMatrix()));
  EXPECT_FALSE(nees(Eigen::Vector2d(NAN, 1.0), Eigen::Matrix2d::Identity().eval()));
}

TEST(Percentiles, AreTakenByTheNearestRank) {
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  const std::optional<Percentiles> result = percentiles(values);
  EXPECT_EQ(result->p50, 100.0);
  EXPECT_EQ(result->p95, 190.0);
  EXPECT_EQ(result->p99, 198.0);
  EXPECT_EQ(result->max, 200.0);
  std::vector<double> one = {7.0};
  EXPECT_EQ(percentiles(one)->p50, 7.0);
  EXPECT_FALSE(percentiles({}));
}

TEST(SpreadSample, IsEvenAndNeverTooLarge) {
  EXPECT_EQ(spread_sample(10, 5), (std::vector<std::size_t>{0, 2, 4, 6, 8}));
  EXPECT_EQ(spread_sample(3, 5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(spread_sample(0, 5).empty());
}

}  // namespace
}  // namespace harness
