// What each reader gives for a small log made by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"
#include "harness/readers/victoria_park.hpp"
#include "logs.hpp"

namespace harness {
namespace {

using namespace test;

std::unique_ptr<RecordedLog> open(const TemporaryFolder& folder, const Files& files, LogChoice choice = {}) {
  write_files(folder.path(), files);
  choice.path = files.size() == 1 ? folder / files.begin()->first : folder.path();
  return open_log(choice);
}

TEST(MrclamLog, CutsArcsWhereAScanComesInBetween) {
  const TemporaryFolder folder;
  const auto log = open(folder, mrclam_files(), {.robot = 2});
  const std::vector<Event> events = read_all(*log);
  ASSERT_EQ(events.size(), 8U);
  EXPECT_EQ(odometry(events[0]).odometry.t, 0.25);
  EXPECT_NEAR(odometry(events[0]).odometry.T_previous_current.x, 0.25, 1e-12);
  EXPECT_EQ(scan(events[1]).scan.t, 0.25);
  EXPECT_EQ(odometry(events[2]).odometry.t, 0.5);
  EXPECT_EQ(odometry(events[4]).odometry.t, 1.4);
  EXPECT_EQ(odometry(events[4]).odometry.T_previous_current.x, 0.0);
  EXPECT_NEAR(odometry(events[5]).odometry.T_previous_current.theta, 0.25, 1e-12);
  EXPECT_EQ(scan(events[6]).scan.t, 1.9);
  EXPECT_EQ(odometry(events[7]).odometry.t, 2.4);
}

TEST(MrclamLog, KeepsLandmarksAloneAndCountsTheRest) {
  const TemporaryFolder folder;
  const auto log = open(folder, mrclam_files(), {.robot = 2});
  const std::vector<Event> events = read_all(*log);
  ASSERT_EQ(scan(events[1]).scan.observations.size(), 2U);
  EXPECT_EQ(scan(events[1]).scan.observations[0].landmark, 6);
  EXPECT_EQ(scan(events[1]).scan.observations[1].landmark, 7);
  const ReadCounts counts = log->counts();
  EXPECT_EQ(counts.robots, 1);
  EXPECT_EQ(counts.unknown_ids, 1);
  EXPECT_EQ(counts.without_odometry, 2);
  EXPECT_EQ(counts.odometry_gaps, 1);
  EXPECT_EQ(counts.truth_gaps, 1);
  EXPECT_EQ(counts.not_finite + counts.backwards + counts.repeated + counts.negative_ranges, 0);
}

TEST(MrclamLog, CountsNonsenseAndGoesOn) {
  const TemporaryFolder folder;
  Files files = mrclam_files();
  files["Robot2_Odometry.dat"] += "1001.0 1 1\n1002.5 nan 0\n";
  files["Robot2_Measurement.dat"] =
      "1000.25 63 2.9 0.35\n1000.25 63 2.9 0.35\n1000.25 81 -1 0\n1000.1 81 1 0\n"
      "1000.5 81 inf 0\n";
  const auto log = open(folder, files, {.robot = 2});
  read_all(*log);
  EXPECT_EQ(log->counts().not_finite, 2);
  EXPECT_EQ(log->counts().backwards, 2);
  EXPECT_EQ(log->counts().repeated, 1);
  EXPECT_EQ(log->counts().negative_ranges, 1);
}

TEST(FreiburgLog, CountsNonsenseAndGoesOn) {
  const TemporaryFolder folder;
  Files files = freiburg_files();
  files["sensor_data.dat"] += "ODOMETRY 0 0.5 0\nSENSOR 1 nan 0\nSENSOR 2 2.0 inf\nSENSOR 2 1.9 -0.9\n";
  const auto log = open(folder, files);
  const std::vector<Event> events = read_all(*log);
  EXPECT_EQ(scan(events.back()).scan.observations.size(), 1U);
  EXPECT_EQ(log->counts().not_finite, 2);
  EXPECT_EQ(log->counts().negative_ranges, 1);
}

TEST(VictoriaParkLog, CountsNonsenseAndGoesOn) {
  const TemporaryFolder folder;
  Files files = victoria_park_files();
  files["derived_tree_detections.txt"] += "1 11.0 -4 0.9 0.3\n";
  const auto log = open(folder, files);
  const std::size_t events = read_all(*log).size();
  EXPECT_EQ(log->counts().negative_ranges, 1);
  EXPECT_EQ(events, read_all(*open(folder, victoria_park_files())).size());
}

TEST(G2oGraph, CountsLandmarksThatAreNowhereAndGoesOn) {
  const TemporaryFolder folder;
  Files files = g2o_files();
  files["graph.g2o"] += "EDGE_SE2_XY 5 10 nan 1 100 0 100\n";
  const auto log = open(folder, files);
  EXPECT_EQ(scan(read_all(*log).back()).scan.observations.size(), 1U);
  EXPECT_EQ(log->counts().not_finite, 1);
}

TEST(MrclamLog, HasNoTruthInGapsAndStartsAtTheTruth) {
  const TemporaryFolder folder;
  Files files = mrclam_files();
  const auto log = open(folder, files, {.robot = 2});
  EXPECT_EQ(log->description().start.mean.x, 0.0);
  ASSERT_EQ(log->description().landmarks->size(), 2U);
  const std::vector<Event> events = read_all(*log);
  ASSERT_TRUE(scan(events[1]).truth);
  EXPECT_NEAR(scan(events[1]).truth->T_world_robot.x, 0.25, 1e-9);
  EXPECT_FALSE(odometry(events[2]).truth);  // 0.5 s is between rows that are 0.6 s apart
  ASSERT_TRUE(scan(events[6]).truth);
  EXPECT_NEAR(scan(events[6]).truth->T_world_robot.theta, 0.25, 1e-9);
}

class Graph : public testing::TestWithParam<Files> {};
INSTANTIATE_TEST_SUITE_P(Formats, Graph, testing::Values(isam_files(), g2o_files()));

TEST_P(Graph, IsTheSameStreamInBothFormats) {
  const TemporaryFolder folder;
  const auto log = open(folder, GetParam());
  const std::vector<Event> events = read_all(*log);
  ASSERT_EQ(events.size(), 6U);
  EXPECT_EQ(scan(events[0]).scan.t, 0.0);
  EXPECT_EQ(odometry(events[2]).odometry.t, 2.0);
  EXPECT_EQ(odometry(events[4]).odometry.t, 3.0);
  // The second motion's R' R is [2500 50; 50 2501].
  const Eigen::Matrix3d& covariance = odometry(events[2]).odometry.covariance;
  EXPECT_NEAR(covariance(0, 0), 2501.0 / (2500.0 * 2501.0 - 2500.0), 1e-12);
  EXPECT_NEAR(covariance(0, 1), -50.0 / (2500.0 * 2501.0 - 2500.0), 1e-12);
  EXPECT_NEAR(covariance(2, 2), 1e-4, 1e-12);
  const seif::Observation& seen = scan(events[5]).scan.observations.front();
  EXPECT_EQ(seen.landmark, 11);
  EXPECT_NEAR(seen.range, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(seen.bearing, std::atan2(-1.0, 1.0), 1e-12);
}

// By hand: the robot faces left at the end of the motion, so a point ahead of it is to the left of the start.
TEST(G2oGraph, HasTheErrorsOfAMotionInTheFrameOfItsEnd) {
  const TemporaryFolder folder;
  const auto log = open(folder, {{"graph.g2o", "EDGE_SE2 0 1 2 1 1.5707963267948966 1 0 0 4 0 9\n"}});
  const std::vector<Event> events = read_all(*log);
  const Eigen::Matrix3d expected = Eigen::Vector3d(1.0 / 4, 1.0, 1.0 / 9).asDiagonal();
  EXPECT_TRUE(odometry(events.at(0)).odometry.covariance.isApprox(expected, 1e-12));
}

TEST_P(Graph, TurnsPointsIntoRangesAndBearingsWithTheirCovariance) {
  const TemporaryFolder folder;
  const auto log = open(folder, GetParam());
  const std::vector<Event> events = read_all(*log);
  // A round covariance of 0.01 m^2 stays round at the range of 2 sqrt(2) m.
  const seif::Observation& round = scan(events[0]).scan.observations.front();
  EXPECT_NEAR(round.covariance(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(round.covariance(1, 1), 0.01 / 8.0, 1e-12);
  EXPECT_NEAR(round.covariance(0, 1), 0.0, 1e-12);
  // Converted back to a point it is the value in the log: its information is [100 20; 20 29].
  const seif::Observation& seen = scan(events[5]).scan.observations.front();
  const double c = std::cos(seen.bearing);
  const double s = std::sin(seen.bearing);
  Eigen::Matrix2d J_point_wrt_z;
  J_point_wrt_z << c, -seen.range * s, s, seen.range * c;
  const Eigen::Matrix2d point = J_point_wrt_z * seen.covariance * J_point_wrt_z.transpose();
  const double determinant = 100.0 * 29.0 - 400.0;
  EXPECT_NEAR(point(0, 0), 29.0 / determinant, 1e-12);
  EXPECT_NEAR(point(0, 1), -20.0 / determinant, 1e-12);
  EXPECT_NEAR(point(1, 1), 100.0 / determinant, 1e-12);
}

TEST(GraphTruth, GivesPosesAndLandmarks) {
  const TemporaryFolder folder;
  write_files(folder.path(), true_isam_files());
  const auto log = open(folder, isam_files(), {.truth = folder / "truth.txt"});
  const std::vector<Event> events = read_all(*log);
  EXPECT_EQ(odometry(events[4]).truth->T_world_robot.x, 3.0);
  const std::vector<TrueLandmark>& landmarks = *log->description().landmarks;
  ASSERT_EQ(landmarks.size(), 2U);
  EXPECT_NEAR((landmarks[0].position - Eigen::Vector2d(2, 2)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((landmarks[1].position - Eigen::Vector2d(4, -1)).norm(), 0.0, 1e-12);
}

TEST(FreiburgLog, TurnsDrivesAndTurns) {
  const TemporaryFolder folder;
  const auto log = open(folder, freiburg_files());
  const std::vector<Event> events = read_all(*log);
  ASSERT_EQ(events.size(), 4U);
  const seif::Pose2& step = odometry(events[0]).odometry.T_previous_current;
  EXPECT_NEAR(step.x, std::cos(0.1), 1e-12);
  EXPECT_NEAR(step.y, std::sin(0.1), 1e-12);
  EXPECT_NEAR(step.theta, 0.0, 1e-12);
  EXPECT_EQ(scan(events[1]).scan.observations.size(), 2U);
  EXPECT_EQ(scan(events[3]).scan.observations.size(), 1U);
  EXPECT_EQ(log->counts().negative_ranges, 1);
  EXPECT_EQ(log->description().landmarks->at(1).position, Eigen::Vector2d(4, -1));
}

TEST(VictoriaParkLog, DrivesAsTheCarDoesAndNamesNoTree) {
  const TemporaryFolder folder;
  const auto log = open(folder, victoria_park_files());
  EXPECT_FALSE(log->description().known_association);
  EXPECT_EQ(log->description().T_robot_sensor.x, 3.78);
  const std::vector<Event> events = read_all(*log);
  ASSERT_EQ(events.size(), 6U);
  EXPECT_NEAR(odometry(events[0]).odometry.T_previous_current.x, 0.5, 1e-12);
  for (const seif::Observation& tree : scan(events[1]).scan.observations)
    EXPECT_EQ(tree.landmark, seif::no_landmark);
  EXPECT_EQ(scan(events[4]).scan.observations.size(), 3U);
  // In a turn to the left, the rear left wheel is on the inner circle, whose radius is L / tan(steering) - H.
  const double steering = 0.3;
  const double radius = 2.83 / std::tan(steering);
  const VelocityRow left = car_velocity(0.0, 2.0, steering);
  EXPECT_NEAR(left.omega, 2.0 / (radius - 0.76), 1e-12);
  EXPECT_NEAR(left.v, left.omega * radius, 1e-12);
}

TEST(LogNoise, IsThatOfTheFormatUnlessItIsToldOtherwise) {
  const TemporaryFolder folder;
  write_file(folder / "noise.yaml", "range_sd_m: 0.5\nturn_sd_rad_per_sqrt_m: 0.25\n");
  const LogNoise fallback{OdometryNoise{0.1, 0.2, 0.3, 0.4}, std::nullopt};
  const LogNoise noise = read_noise(
      {.file = folder / "noise.yaml", .overrides = {"noise.bearing_sd_rad=0.1", "noise.range_sd_m=0.6"}},
      fallback);
  EXPECT_EQ(noise.sensor->range_sd, 0.6);
  EXPECT_EQ(noise.sensor->bearing_sd, 0.1);
  EXPECT_EQ(noise.odometry->turn_sd_per_sqrt_m, 0.25);
  EXPECT_EQ(noise.odometry->distance_sd_per_sqrt_m, 0.1);
  EXPECT_FALSE(read_noise({.overrides = {"noise.turn_sd_rad_per_sqrt_m=1"}}, {}).sensor);
  EXPECT_THROW(read_noise({.overrides = {"noise.range_sd_m=1"}}, {}), BadInput);
  EXPECT_THROW(read_noise({.overrides = {"noise.rang_sd_m=1"}}, fallback), BadInput);
  EXPECT_THROW(read_noise({.overrides = {"noise.range_sd_m=-1"}}, fallback), BadInput);
}

TEST(LogNoise, AddsUpOverTheWayHoweverItIsCut) {
  const OdometryNoise noise{0.1, 0.2, 0.3, 0.4};
  const Eigen::Matrix3d whole = covariance(noise, {2.0, 0.0, 0.5});
  const Eigen::Matrix3d half = covariance(noise, {1.0, 0.0, 0.25});
  EXPECT_LT((whole - 2.0 * half).norm(), 1e-15);
  EXPECT_NEAR(whole(2, 2), 0.09 * 2.0 + 0.16 * 0.5, 1e-15);
}

TEST(LogNoise, ReplacesWhatStandsInALog) {
  const TemporaryFolder folder;
  LogChoice choice;
  choice.noise.overrides = {"noise.range_sd_m=0.5", "noise.bearing_sd_rad=0.1"};
  const auto log = open(folder, isam_files(), choice);
  const std::vector<Event> events = read_all(*log);
  EXPECT_NEAR(scan(events[0]).scan.observations.front().covariance(0, 0), 0.25, 1e-12);
  EXPECT_NEAR(odometry(events[2]).odometry.covariance(2, 2), 1e-4, 1e-12);  // not given: unchanged
}

}  // namespace
}  // namespace harness
