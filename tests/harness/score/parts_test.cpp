// The parts of the detailed scores, against values computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "harness/score/loop_closure.hpp"
#include "harness/score/map_counts.hpp"
#include "harness/score/rebuilt.hpp"
#include "harness/score/score.hpp"
#include "harness/statistics/chi_square.hpp"

namespace harness {
namespace {

using std::numbers::pi;
constexpr double rounding = 1e-12;

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(PairsApart, AreTheNearestWithinATenth) {
  const std::vector<double> values = {0.0, 0.95, 1.02, 1.5, 2.06, 2.3};
  // The value for 0 should be 1: 1.02 is near enough. For 0.95 it should be 1.95: 2.06 is too far. For 1.02 it
  // should be 2.02: 2.06. For 1.5 it should be 2.5: 2.3 is too far.
  EXPECT_EQ(pairs_apart(values, 1.0), (Pairs{{0, 2}, {2, 4}}));
  EXPECT_EQ(pairs_apart({}, 1.0), Pairs{});
}

TEST(PairsApart, OfEqualValuesTheFirstCounts) {
  const std::vector<double> standing = {0.0, 0.0, 1.0, 1.0, 1.0};
  EXPECT_EQ(pairs_apart(standing, 1.0), (Pairs{{0, 2}, {1, 2}}));
  const std::vector<double> at_the_end = {0.0, 0.95, 0.95};
  EXPECT_EQ(pairs_apart(at_the_end, 1.0), (Pairs{{0, 1}}));
}

// Quantiles of the chi-square distribution at 2.5 % and 97.5 %: for 2 degrees of freedom 0.0506 and 7.378, for
// 4 0.4844 and 11.143, for 6 1.2373 and 14.449.
TEST(ScoreScans, EachScanHasItsDegreesOfFreedom) {
  const std::vector<ScanNis> scans = {{3.0, 2}, {3.0, 4}};  // 6 of 7.378, but 12 of 11.143
  const ScanNisScore score = score_scans(scans);
  EXPECT_NEAR(*score.nis, (3.0 * 2 + 3.0 * 4) / 6, rounding);
  EXPECT_EQ(score.inside, 0.5);
  EXPECT_EQ(score.count, 2U);
  EXPECT_NEAR(score.band->low, 1.2373 / 6, 1e-4);
  EXPECT_NEAR(score.band->high, 14.449 / 6, 1e-4);
}

TEST(ScoreScans, OfNoneAreNothing) {
  const ScanNisScore score = score_scans({});
  EXPECT_FALSE(score.nis || score.band || score.inside);
}

/// One metre ahead, a turn on the spot, one metre to the left. The estimates are 1.1 m, 0.9 m, and a turn that
/// is too small by 0.2.
std::vector<PosePair> corner() {
  const double turn = pi / 2 - 0.2;
  const seif::Pose2 est = seif::Pose2{1.1, 0, 0} * seif::Pose2{0, 0, turn} * seif::Pose2{0.9, 0, 0};
  return {{0, {}, {}},
          {1, {1.1, 0, 0}, {1, 0, 0}},
          {2, {1.1, 0, turn}, {1, 0, pi / 2}},
          {3, est, {1, 1, pi / 2}}};
}

TEST(RelativePoseErrorAlongPath, MatchesTheHandComputedCase) {
  // Pairs one metre apart: 0 and 1 (0.1 m too far), 1 and 3 (the path between them is the second metre), 2 and
  // 3 (0.1 m too short). Seen from 1, the truth went (0, 1) and the estimate 0.9 (cos, sin)(pi/2 - 0.2).
  const double aside = 0.9 * std::sin(0.2);
  const double ahead = 0.9 * std::cos(0.2) - 1.0;
  const RelativePoseError error = relative_pose_error_along_path(corner(), 1.0);
  EXPECT_NEAR(*error.translation, std::sqrt((0.01 + aside * aside + ahead * ahead + 0.01) / 3), rounding);
  EXPECT_NEAR(*error.rotation, std::sqrt(0.04 / 3), rounding);
  EXPECT_FALSE(relative_pose_error_along_path(corner(), 3.0).translation) << "the whole way is 2 m";
  EXPECT_TRUE(relative_pose_error_along_path(corner(), 2.0).translation) << "and not the diagonal's 1.4 m";
}

TEST(RmseFromRobot, LeavesOutWhatRobotAndMapShare) {
  // The whole map and the robot are turned and moved together: seen from the robot, there is no error.
  const seif::Pose2 T{3, -2, 0.7};
  const seif::Pose2 true_pose{1, 1, 0.3};
  std::vector<PointPair> points;
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(1, 2), Eigen::Vector2d(-4, 5)})
    points.push_back({T * p, p});
  EXPECT_NEAR(*rmse_from_robot(points, {0, T * true_pose, true_pose}), 0.0, rounding);
  // A robot that believes itself 0.3 m too far ahead sees everything 0.3 m too near.
  EXPECT_NEAR(*rmse_from_robot(points, {0, T * true_pose * seif::Pose2{0.3, 0, 0}, true_pose}), 0.3,
              rounding);
  EXPECT_FALSE(rmse_from_robot({}, {}));
}

/// A robot whose heading has a sigma of 0.2 rad, and a landmark two metres ahead of it.
Eigen::Matrix<double, 5, 5> independent() {
  return Eigen::Matrix<double, 5, 1>(0.01, 0.01, 0.04, 0.01, 0.01).asDiagonal();
}

TEST(NeesFromRobot, MatchesTheHandComputedCase) {
  // Seen from the robot, x has variance 0.01 + 0.01, y 0.01 + 0.01 + 2^2 * 0.04.
  const PosePair pose{0, {}, {}};
  EXPECT_NEAR(*nees_from_robot(pose, {{2, 0}, {2, 0.3}}, independent()), 0.09 / 0.18 / 2, rounding);
  EXPECT_NEAR(*nees_from_robot(pose, {{2, 0}, {2.1, 0}}, independent()), 0.01 / 0.02 / 2, rounding);
}

TEST(NeesFromRobot, TheHeadingAloneMovesWhatIsSeen) {
  // The robot believes that it looks north, with the landmark three metres to its right: a turn by d moves the
  // landmark by 3 d along the robot's x.
  const PosePair pose{0, {1, 1, pi / 2}, {1, 1, pi / 2 + 0.1}};
  Eigen::Matrix<double, 5, 5> joint = independent();
  joint.diagonal() << 0, 0, 0.04, 1e-9, 1e-9;
  const double along = 3 * std::sin(0.1);
  EXPECT_NEAR(*nees_from_robot({0, pose.est_pose, {1, 1, pi / 2}}, {{4, 1}, {4, 1}}, joint), 0.0, rounding);
  joint.diagonal() << 0, 0, 0.04, 0.5, 0.5;
  const double across = 3 * (1 - std::cos(0.1));
  const double expected = along * along / (0.5 + 9 * 0.04) + across * across / 0.5;
  EXPECT_NEAR(*nees_from_robot(pose, {{4, 1}, {4, 1}}, joint), expected / 2, rounding);
}

TEST(NeesFromRobot, LeavesOutWhatRobotAndMapShare) {
  // Robot and landmark have errors of metres together, and of 0.1 m relative to each other.
  Eigen::Matrix<double, 5, 5> joint = Eigen::Matrix<double, 5, 5>::Zero();
  for (const int axis : {0, 1}) {
    joint(axis, axis) = 4;
    joint(axis, 3 + axis) = joint(3 + axis, axis) = 4;
    joint(3 + axis, 3 + axis) = 4.01;
  }
  const PosePair pose{0, {7, -2, 0}, {4, 2, 0}};
  EXPECT_NEAR(*nees_from_robot(pose, {{9, -2}, {6, 2.1}}, joint), 0.01 / 0.01 / 2, 1e-9);
}

TEST(NeesFromRobot, IsNothingWithoutAProperBelief) {
  EXPECT_FALSE(nees_from_robot({0, {}, {}}, {{2, 0}, {2, 0}}, -independent()));
}

TEST(ChiSquareBand, HasTheValuesOfTheTables) {
  // Quantiles 2.5 % and 97.5 %: 0.0506 and 7.3778 for two degrees of freedom, 0.2158 and 9.3484 for three.
  EXPECT_NEAR(chi_square_band(2).low, 0.0506 / 2, 5e-5);
  EXPECT_NEAR(chi_square_band(2).high, 7.3778 / 2, 5e-5);
  EXPECT_NEAR(chi_square_band(3).low, 0.2158 / 3, 5e-5);
  EXPECT_NEAR(chi_square_band(3).high, 9.3484 / 3, 5e-5);
}

TEST(ShareInside, CountsTheEdges) {
  const std::vector<double> values = {0.9, 1.0, 1.5, 2.0, 2.1};
  EXPECT_EQ(share_inside(values, {1.0, 2.0}), 0.6);
  EXPECT_FALSE(share_inside({}, {1.0, 2.0}));
}

TEST(CountLandmarks, MatchesTheHandComputedCase) {
  const std::vector<TrueLandmark> truth = {
      {1, {0, 0}, 0.1}, {2, {4, 0}, 0.1}, {3, {0, 4}, 0.1}, {5, {9, 9}, 0.1}};
  // The map is shifted by 10 m, and knows landmarks 1 and 2. Its entry 7 is at landmark 2, entry 8 at landmark
  // 3, which the map does not have, and entry 9 at no landmark.
  const std::vector<MapRecord> map = {
      {1, {10, 0}, {}}, {2, {14, 0}, {}}, {7, {14.3, 0.3}, {}}, {8, {10, 4}, {}}, {9, {5, 5}, {}}};
  const MapCounts counts = count_landmarks(map, truth, std::set<seif::LandmarkId>{1, 2, 3});
  EXPECT_EQ(counts.missed, 1) << "3 was seen; 5 never was";
  EXPECT_EQ(counts.spurious, 3);
  EXPECT_EQ(counts.duplicate, 1);
}

TEST(LoopClosures, AreReturnsAfterAnAbsence) {
  const std::vector<SeenScan> scans = {{0, {1, 2}}, {1, {2}},  {5, {3}},  {9, {3}}, {10, {1}},
                                       {11, {2}},   {21, {1}}, {30, {1}}, {41, {3}}};
  // Landmark 1 returns after 10 s, 2 shortly after it: one closure. At 21 s landmark 1 returns after 11 s. At
  // 30 s it was away for only 9 s. At 41 s landmark 3 returns after 32 s.
  EXPECT_EQ(loop_closures(scans, 10.0), (std::vector<std::size_t>{4, 6, 8}));
  EXPECT_EQ(loop_closures(scans, 100.0), (std::vector<std::size_t>{}));
}

TEST(ClosureResponse, IsTheRootMeanSquareOverTheClosures) {
  const std::vector<std::size_t> closures = {1, 4};
  const std::vector<double> errors = {3.0, 1.0, 0.5, 4.0, 7.0, 0.1};
  const auto response = closure_response(closures, errors);
  ASSERT_EQ(response_updates[1], 0);
  EXPECT_DOUBLE_EQ(*response[0], std::sqrt((9.0 + 16.0) / 2));  // before
  EXPECT_DOUBLE_EQ(*response[1], std::sqrt((1.0 + 49.0) / 2));
  EXPECT_DOUBLE_EQ(*response[2], std::sqrt((0.25 + 0.01) / 2));
  EXPECT_DOUBLE_EQ(*response[3], 4.0) << "two updates after the second the run is over";
  EXPECT_FALSE(response[5]);
}

}  // namespace
}  // namespace harness
