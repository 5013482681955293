#include "harness/stream/log_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::write_file;

constexpr double pi = std::numbers::pi;

const char* const odometry_head = "t,dx,dy,dtheta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt\n";
const char* const observations_head = "t,landmark,range,bearing\n";

/// A log of three readings and three scans, one of them empty.
void write_log(const TemporaryFolder& folder) {
  write_file(
      folder / "log.yaml",
      "name: hand made\nassociation: known\nrange_sd_m: 0.1\nrange_sd_per_m: 0.2\nbearing_sd_rad: 0.02\n"
      "start: {x_m: 1, y_m: 2, theta_rad: 0.5, cov_xx: 0.01, cov_yy: 0.04, cov_tt: 0.001}\n");
  write_file(folder / "odometry.csv", std::string(odometry_head) +
                                          "0.5,0.1,0,0,1e-4,0,0,1e-4,0,1e-6\n"
                                          "1,0.1,0,0.1,1e-4,0,0,1e-4,0,1e-6\n"
                                          "1.5,0.1,0,0,0,0,0,0,0,0\n");
  write_file(folder / "observations.csv",
             std::string(observations_head) + "0.7,3,2.5,0.1\n0.7,9,1,-3\n1\n1.5,3,2,0\n");
}

std::vector<Event> read_all(LogStream& stream) {
  std::vector<Event> events;
  Event event;
  while (stream.next(event)) events.push_back(event);
  return events;
}

const ScanEvent& scan(const Event& event) { return std::get<ScanEvent>(event); }
const OdometryEvent& odometry(const Event& event) { return std::get<OdometryEvent>(event); }

TEST(LogStream, TellsOfScansLongAfterTheOdometry) {
  const TemporaryFolder folder;
  write_log(folder);
  write_file(folder / "observations.csv",
             std::string(observations_head) + "0.7,3,2.5,0.1\n2.4,3,2,0\n2.6,3,2,0\n3,3,2,0\n");
  LogStream stream(folder.path());
  EXPECT_EQ(read_all(stream).size(), 7U);
  EXPECT_EQ(stream.counts().scans_after_odometry, 2) << "the last odometry is at 1.5 s";
  write_file(folder / "odometry.csv", odometry_head);
  LogStream without(folder.path());
  EXPECT_EQ(read_all(without).size(), 4U);
  EXPECT_EQ(without.counts().scans_after_odometry, 3) << "the start is at 0 s";
}

TEST(LogStream, MergesOdometryAndScansWithOdometryFirst) {
  const TemporaryFolder folder;
  write_log(folder);
  LogStream stream(folder.path());
  const std::vector<Event> events = read_all(stream);
  ASSERT_EQ(events.size(), 6U);
  EXPECT_EQ(odometry(events[0]).odometry.t, 0.5);
  EXPECT_EQ(scan(events[1]).scan.observations.size(), 2U);
  EXPECT_EQ(odometry(events[2]).odometry.t, 1.0);
  EXPECT_TRUE(scan(events[3]).scan.observations.empty());
  EXPECT_EQ(odometry(events[4]).odometry.t, 1.5);
  EXPECT_EQ(scan(events[5]).scan.observations.front().landmark, 3);
}

TEST(LogStream, TakesMissingCovariancesFromTheNoise) {
  const TemporaryFolder folder;
  write_log(folder);
  LogStream stream(folder.path());
  const Eigen::Matrix2d covariance = scan(read_all(stream)[1]).scan.observations.front().covariance;
  EXPECT_DOUBLE_EQ(covariance(0, 0), 0.1 * 0.1 + 0.5 * 0.5);
  EXPECT_DOUBLE_EQ(covariance(1, 1), 0.02 * 0.02);
  EXPECT_EQ(covariance(0, 1), 0.0);
}

TEST(LogStream, ReadsItsDescription) {
  const TemporaryFolder folder;
  write_log(folder);
  const LogStream stream(folder.path());
  const LogDescription& log = stream.description();
  EXPECT_EQ(log.name, "hand made");
  EXPECT_EQ(log.start.mean.theta, 0.5);
  EXPECT_EQ(log.start.covariance(1, 1), 0.04);
  EXPECT_FALSE(log.has_truth);
  EXPECT_FALSE(log.landmarks);
}

TEST(LogDescription, ComesBackBitForBit) {
  const TemporaryFolder folder;
  LogDescription log;
  log.name = "a \"strange\": name # \xc3\xa4";
  log.T_robot_sensor = {0.1, 1.0 / 3.0, -0.7};
  log.noise = {0.1 + 0.2, 1e-17, 1.0 / 7.0};
  log.start_t = 1.2e9 + 1.0 / 3.0;
  log.start.mean = {1e-300, -2.0 / 3.0, 3.0};
  log.start.covariance << 0.3, 0.1, 0.01, 0.1, 1.0 / 3.0, 0.02, 0.01, 0.02, 0.5;
  write_file(folder / "log.yaml", to_yaml(log));
  LogDescription read;
  read_yaml(folder / "log.yaml", read);
  EXPECT_EQ(read.name, log.name);
  EXPECT_EQ(read.T_robot_sensor.y, log.T_robot_sensor.y);
  EXPECT_EQ(read.noise.range_sd, log.noise.range_sd);
  EXPECT_EQ(read.noise.range_sd_per_m, log.noise.range_sd_per_m);
  EXPECT_EQ(read.start_t, log.start_t);
  EXPECT_EQ(read.start.mean.x, log.start.mean.x);
  EXPECT_EQ(read.start.covariance, log.start.covariance);
}

TEST(LogStream, TruthBetweenRowsIsInterpolatedAndTurnsTheShortWay) {
  const TemporaryFolder folder;
  write_log(folder);
  write_file(folder / "truth.csv", "t,x,y,theta\n0.5,0,0,3\n0.9,4,8,-3\n1,5,5,0\n");
  LogStream stream(folder.path());
  const std::vector<Event> events = read_all(stream);
  EXPECT_FALSE(stream.description().true_start);
  EXPECT_EQ(odometry(events[0]).truth->T_world_robot.theta, 3.0);
  const seif::Pose2 between = scan(events[1]).truth->T_world_robot;
  EXPECT_NEAR(between.x, 2.0, 1e-12);
  EXPECT_NEAR(between.y, 4.0, 1e-12);
  EXPECT_NEAR(std::abs(between.theta), pi, 1e-12);
  EXPECT_EQ(scan(events[3]).truth->T_world_robot.x, 5.0);
  EXPECT_FALSE(scan(events[5]).truth) << "there is no truth after the last row";
}

TEST(LogStream, ReadsLandmarksInAnyOrderWithAndWithoutRadius) {
  const TemporaryFolder folder;
  write_file(folder / "a.csv", "landmark,x,y\n7,1,2\n3,4,5\n");
  write_file(folder / "b.csv", "landmark,x,y,radius\n2147483646,1,2,0.5\n");
  EXPECT_EQ(read_landmarks(folder / "a.csv").front().landmark, 3);
  EXPECT_EQ(read_landmarks(folder / "b.csv").front().radius, 0.5);
}

TEST(LogStream, TrueIdsStandBesideTheObservations) {
  const TemporaryFolder folder;
  write_log(folder);
  write_file(folder / "observations_true_ids.csv", "t,true_landmark\n0.7,3\n0.7,\n1,\n1.5,4\n");
  LogStream stream(folder.path());
  const std::vector<Event> events = read_all(stream);
  EXPECT_EQ(scan(events[1]).true_ids, (std::vector<seif::LandmarkId>{3, seif::no_landmark}));
  EXPECT_TRUE(scan(events[3]).true_ids.empty());
  EXPECT_EQ(scan(events[5]).true_ids, std::vector<seif::LandmarkId>{4});
}

TEST(LogStream, WithUnknownAssociationNoObservationNamesItsLandmark) {
  const TemporaryFolder folder;
  write_log(folder);
  write_file(folder / "log.yaml",
             "name: a\nassociation: unknown\nrange_sd_m: 0.1\nbearing_sd_rad: 0.02\n"
             "start: {x_m: 0, y_m: 0, theta_rad: 0, cov_xx: 1, cov_yy: 1, cov_tt: 1}\n");
  write_file(folder / "observations.csv",
             "t,landmark,range,bearing\n0.7,,2,0.1\n0.7,,2,0.1\n1,,,\n1.5,,3,0\n");
  LogStream stream(folder.path());
  EXPECT_FALSE(stream.description().known_association);
  const std::vector<Event> events = read_all(stream);
  ASSERT_EQ(scan(events[1]).scan.observations.size(), 2U) << "two trees may look the same";
  for (const seif::Observation& z : scan(events[1]).scan.observations)
    EXPECT_EQ(z.landmark, seif::no_landmark);
  EXPECT_TRUE(scan(events[3]).scan.observations.empty());
}

struct BrokenLog {
  const char* file;
  std::string text;
  const char* complaint;  // file:line:column: and the beginning of the reason
};

class BrokenLogs : public testing::TestWithParam<BrokenLog> {};

TEST_P(BrokenLogs, AreRefusedWithPlaceAndReason) {
  const TemporaryFolder folder;
  write_log(folder);
  write_file(folder / GetParam().file, GetParam().text);
  try {
    LogStream stream(folder.path());
    read_all(stream);
    FAIL() << "was accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam().complaint), std::string::npos) << error.what();
  }
}

const std::string odo = odometry_head;
const std::string obs = observations_head;

INSTANTIATE_TEST_SUITE_P(
    LogStream, BrokenLogs,
    testing::Values(
        BrokenLog{"odometry.csv", "", "odometry.csv:1:1: is empty"},
        BrokenLog{"odometry.csv", "t,dx,dy\n", "odometry.csv:1:8: wrong header"},
        BrokenLog{"odometry.csv", "t,dx,DY,dtheta\n", "odometry.csv:1:6: wrong header"},
        BrokenLog{"odometry.csv", odo + "1,0,0\n", "odometry.csv:2:6: dtheta: is missing"},
        BrokenLog{"odometry.csv", odo + "1,0,0,0,0,0,0,0,0,0,0\n",
                  "odometry.csv:2:21: the row has 11 values"},
        BrokenLog{"odometry.csv", odo + "1,nan,0,0,0,0,0,0,0,0\n",
                  "odometry.csv:2:3: dx: 'nan' is not finite"},
        BrokenLog{"odometry.csv", odo + "1,0,1e999,0,0,0,0,0,0,0\n",
                  "odometry.csv:2:5: dy: '1e999' is beyond"},
        BrokenLog{"odometry.csv", odo + "1,0,0,x,0,0,0,0,0,0\n",
                  "odometry.csv:2:7: dtheta: 'x' is not a number"},
        BrokenLog{"odometry.csv", odo + "1,0,0,1 2,0,0,0,0,0,0\n",
                  "odometry.csv:2:7: dtheta: '1 2' is not a number"},
        BrokenLog{"odometry.csv", odo + "1,0,0,0,0,0,0,0,0,0\n0.5,0,0,0,0,0,0,0,0,0\n",
                  "odometry.csv:3:1: t: 0.5 s does not come after 1 s"},
        BrokenLog{"odometry.csv", odo + "1,0,0,0,0,0,0,0,0,0\n1,0,0,0,0,0,0,0,0,0\n",
                  "odometry.csv:3:1: t: 1 s"},
        BrokenLog{"odometry.csv", odo + "-1,0,0,0,0,0,0,0,0,0\n",
                  "odometry.csv:2:1: t: -1 s does not come after 0 s"},
        BrokenLog{"odometry.csv", odo + "1,0,0,0,1,2,0,1,0,0\n", "odometry.csv:2:9: cov_xx: this covariance"},
        BrokenLog{"odometry.csv", odo + "1,0,0,0,-1,0,0,0,0,0\n",
                  "odometry.csv:2:9: cov_xx: this covariance"},
        BrokenLog{"observations.csv", "t,landmark,range\n", "observations.csv:1:17: wrong header"},
        BrokenLog{"observations.csv", obs + "1,-1,1,0\n",
                  "observations.csv:2:3: landmark: '-1' is not a whole number"},
        BrokenLog{"observations.csv", obs + "1,2147483647,1,0\n",
                  "observations.csv:2:3: landmark: '2147483647'"},
        BrokenLog{"observations.csv", obs + "1,1.5,1,0\n", "observations.csv:2:3: landmark: '1.5'"},
        BrokenLog{"observations.csv", obs + "1,,1,0\n", "observations.csv:2:3: landmark: is missing"},
        BrokenLog{"observations.csv", obs + "1,1,-1,0\n", "observations.csv:2:5: range: is negative"},
        BrokenLog{"observations.csv", obs + "1,1,1\n", "observations.csv:2:6: bearing: is missing"},
        BrokenLog{"observations.csv", obs + "1,1,1,0\n1,1,1,0\n",
                  "observations.csv:3:3: landmark: landmark 1 stands twice"},
        BrokenLog{"observations.csv", obs + "2,1,1,0\n1,1,1,0\n",
                  "observations.csv:3:1: t: 1 s does not come after 2 s"},
        BrokenLog{"observations.csv", obs + "1\n1,1,1,0\n", "observations.csv:3:1: t: an empty scan"},
        BrokenLog{"observations.csv", obs + "1,1,1,0\n1,,,\n",
                  "observations.csv:3:3: landmark: an empty scan"},
        BrokenLog{"observations.csv", "t,landmark,range,bearing,cov_rr,cov_rb,cov_bb\n1,1,1,0,1,1,1\n",
                  "observations.csv:2:9: cov_rr: this covariance is not positive definite"},
        BrokenLog{"observations.csv", "t,landmark,range,bearing,cov_rr,cov_rb,cov_bb\n1,1,1,0,1e-18,0,1\n",
                  "cov_rr: this covariance has an error of 1e-09 m or rad; the least allowed is 1e-07"},
        BrokenLog{"observations.csv", "t,landmark,range,bearing,cov_rr,cov_rb,cov_bb\n1,1,1,0,1,0,1e300\n",
                  "cov_rr: this covariance has an error of 1e+150 m or rad; the largest allowed is 1000"},
        BrokenLog{
            "log.yaml",
            "name: a\nrange_sd_m: 1\nbearing_sd_rad: 1\n"
            "start: {x_m: 0, y_m: 0, theta_rad: 0, cov_xx: 1e-24, cov_yy: 1, cov_tt: 1}\n",
            "log.yaml:4:47: this covariance has an error of 1e-12 m or rad; the least allowed is 1e-07"},
        BrokenLog{"log.yaml", "name: a\nrange_sd_m: 1e-9\nbearing_sd_rad: 1\n", "log.yaml:2:13:"},
        BrokenLog{"odometry.csv",
                  "t,dx,dy,dtheta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt\n1,0,0,0,1e300,0,0,1,0,1\n",
                  "odometry.csv:2:9: cov_xx: this covariance has an error of 1e+150 m or rad; the largest"},
        BrokenLog{"observations_true_ids.csv", "t,true_landmark\n", "observations_true_ids.csv has no row"},
        BrokenLog{"truth.csv", "t,x,y,theta\n1,0,0,0\n0,0,0,0\n",
                  "truth.csv:3:1: t: 0 s does not come after 1 s"},
        BrokenLog{"truth.csv", "t,x,y,theta,left_wheel\n", "truth.csv:1:"},
        BrokenLog{"landmarks.csv", "landmark,x,y\n1,0,0\n1,0,0\n", "landmark 1 stands there twice"},
        BrokenLog{"landmarks.csv", "landmark,x,y\n1,inf,0\n", "landmarks.csv:2:3: x: 'inf' is not finite"},
        BrokenLog{"log.yaml", "name: a\n", "log.yaml:1:1: the key 'range_sd_m' is missing"},
        BrokenLog{"log.yaml", "name: [\n", "log.yaml:"},
        BrokenLog{"log.yaml",
                  "name: a\nassociation: unknown\nrange_sd_m: 1\nbearing_sd_rad: 1\n"
                  "start: {x_m: 0, y_m: 0, theta_rad: 0, cov_xx: 1, cov_yy: 1, cov_tt: 1}\n",
                  "landmark: must be empty; in log.yaml stands association: unknown"},
        BrokenLog{"log.yaml",
                  "name: a\nrange_sd_m: -1\nbearing_sd_rad: 1\n"
                  "start: {x_m: 0, y_m: 0, theta_rad: 0, cov_xx: 1, cov_xy: 2, cov_yy: 1, cov_tt: 1}\n",
                  "log.yaml:2:13:"},
        BrokenLog{"log.yaml",
                  "name: a\nrange_sd_m: 1\nbearing_sd_rad: 1\n"
                  "start: {x_m: 0, y_m: 0, theta_rad: 0, cov_xx: 1, cov_xy: 2, cov_yy: 1, cov_tt: 1}\n",
                  "not positive definite"}));

TEST(LogStream, AFolderThatIsNotThereIsRefused) { EXPECT_THROW(LogStream("/no/such/folder"), BadInput); }

TEST(LogStream, AMissingFileIsRefused) {
  const TemporaryFolder folder;
  write_log(folder);
  std::filesystem::remove(folder / "odometry.csv");
  EXPECT_THROW(LogStream(folder.path()), BadInput);
}

}  // namespace
}  // namespace harness
