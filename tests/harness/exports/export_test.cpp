// Exports against values computed by hand, and against the optimum that the harness finds.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "harness/command_call.hpp"
#include "harness/exports/graph.hpp"
#include "harness/exports/trajectories.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::read_file;
using test::write_file;

/// The lines as numbers, sorted by their first word.
std::map<std::string, std::vector<std::vector<double>>> parse(const std::string& g2o) {
  std::map<std::string, std::vector<std::vector<double>>> lines;
  std::istringstream text(g2o);
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string tag;
    words >> tag;
    std::vector<double>& numbers = lines[tag].emplace_back();
    for (double number = 0.0; words >> number;) numbers.push_back(number);
    EXPECT_TRUE(words.eof()) << line;
  }
  return lines;
}

void expect_near(const std::vector<double>& values, const std::vector<double>& wanted) {
  ASSERT_EQ(values.size(), wanted.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], wanted[i], 1e-9 * std::max(1.0, std::abs(wanted[i]))) << i;
}

/// Two motions up to the first scan, one up to the second. Landmark 7 is seen from both, and 3 from the second.
void write_log(const std::filesystem::path& log) {
  std::filesystem::create_directories(log);
  write_file(log / "log.yaml",
             "name: small\nassociation: known\nsensor_mount: {x_m: 0.5, y_m: 0, theta_rad: 0}\n"
             "range_sd_m: 0.1\nbearing_sd_rad: 0.1\n"
             "start: {t_s: 0, x_m: 1, y_m: 2, theta_rad: 0, cov_xx: 0.01, cov_yy: 0.01, cov_tt: 0.01}\n");
  write_file(log / "odometry.csv",
             "t,dx,dy,dtheta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt\n"
             "1,1,0,0,0.04,0,0,0.01,0,0\n"
             "2,1,0,0,0.04,0,0,0.01,0,0.25\n"
             "3,2,0,1,0.25,0,0,0.04,0,0.25\n");
  write_file(log / "observations.csv",
             "t,landmark,range,bearing\n2,7,2,1.5707963267948966\n3,7,1,0\n3,3,4,0\n");
  write_file(log / "filter.tum", "2 3.1 2 0 0 0 0 1\n3 5 2.2 0 0 0 0.479425538604203 0.8775825618903728\n");
  write_file(log / "filter_map.csv", "landmark,x,y,cov_xx,cov_xy,cov_yy\n7,3.5,4.1,,,\n3,8,9,,,\n");
}

TEST(G2o, MatchesTheHandComputedCase) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  auto lines = parse(to_g2o(read_graph(folder / "log", "filter")));
  ASSERT_EQ(lines["VERTEX_SE2"].size(), 3U);
  expect_near(lines["VERTEX_SE2"][0], {0, 1, 2, 0});
  expect_near(lines["VERTEX_SE2"][1], {1, 3.1, 2, 0});
  expect_near(lines["VERTEX_SE2"][2], {2, 5, 2.2, 1});
  ASSERT_EQ(lines["VERTEX_XY"].size(), 2U);
  expect_near(lines["VERTEX_XY"][0], {3, 3.5, 4.1});
  expect_near(lines["VERTEX_XY"][1], {4, 8, 9});
  expect_near(lines["FIX"][0], {0});
  // Two motions of a metre ahead, each with variances 0.04 and 0.01. The first has no uncertainty of the
  // heading that would turn the second.
  ASSERT_EQ(lines["EDGE_SE2"].size(), 2U);
  expect_near(lines["EDGE_SE2"][0], {0, 1, 2, 0, 0, 1 / 0.08, 0, 0, 1 / 0.02, 0, 1 / 0.25});
  // The error of the second motion is expressed in the frame of its end. This is turned by one radian to the
  // left of the frame in which the variances are 0.25 and 0.04.
  const double c = std::cos(1.0);
  const double s = std::sin(1.0);
  expect_near(lines["EDGE_SE2"][1],
              {1, 2, 2, 0, 1, 4 * c * c + 25 * s * s, 21 * c * s, 0, 4 * s * s + 25 * c * c, 0, 4});
  // The sensor is 0.5 m ahead. At 2 m to the left, the range has an error of 0.1 m along y, and the bearing one
  // of 2 * 0.1 along x.
  ASSERT_EQ(lines["EDGE_SE2_XY"].size(), 3U);
  expect_near(lines["EDGE_SE2_XY"][0], {1, 3, 0.5, 2, 25, 0, 100});
  expect_near(lines["EDGE_SE2_XY"][1], {2, 3, 1.5, 0, 100, 0, 100});
  expect_near(lines["EDGE_SE2_XY"][2], {2, 4, 4.5, 0, 100, 0, 1 / 0.16});
}

TEST(Gtsam, MatchesTheHandComputedCase) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  auto lines = parse(to_gtsam(read_graph(folder / "log", "filter")));
  // The pose of the sensor, 0.5 m ahead.
  ASSERT_EQ(lines["VERTEX_SE2"].size(), 3U);
  expect_near(lines["VERTEX_SE2"][1], {1, 3.6, 2, 0});
  expect_near(lines["VERTEX_SE2"][2], {2, 5 + 0.5 * std::cos(1.0), 2.2 + 0.5 * std::sin(1.0), 1});
  expect_near(lines["VERTEX_XY"][1], {4, 8, 9});
  // An error phi of the robot's heading moves the sensor by 0.5 phi to the left: variance 0.02 + 0.25 * 0.25,
  // covariance with the heading 0.5 * 0.25. The determinant of ((0.0825, 0.125), (0.125, 0.25)) is 0.005.
  expect_near(lines["EDGE_SE2"][0],
              {0, 1, 2, 0, 0, 1 / 0.08, 0, 0, 0.25 / 0.005, -0.125 / 0.005, 0.0825 / 0.005});
  ASSERT_EQ(lines["BR"].size(), 3U);
  expect_near(lines["BR"][0], {1, 3, std::numbers::pi / 2, 2, 0.1, 0.1});
  expect_near(lines["BR"][1], {2, 3, 0, 1, 0.1, 0.1});
  expect_near(lines["BR"][2], {2, 4, 0, 4, 0.1, 0.1});
}

/// The squared error of the only motion in a file, by the definition that g2o and GTSAM share:
/// e = Z^-1 (X_0^-1 X_1).
double squared_error(const std::string& file) {
  auto lines = parse(file);
  const auto pose = [](const std::vector<double>& values, std::size_t first) {
    return seif::Pose2{values.at(first), values.at(first + 1), values.at(first + 2)};
  };
  const std::vector<double> edge = lines["EDGE_SE2"].at(0);
  const seif::Pose2 T = inverse(pose(lines["VERTEX_SE2"].at(0), 1)) * pose(lines["VERTEX_SE2"].at(1), 1);
  const seif::Pose2 error = inverse(pose(edge, 2)) * T;
  const Eigen::Vector3d e(error.x, error.y, error.theta);
  Eigen::Matrix3d information;
  information << edge[5], edge[6], edge[7], edge[6], edge[8], edge[9], edge[7], edge[9], edge[10];
  return e.dot(information * e);
}

TEST(Graphs, WeighAMotionByItsCovarianceWhereItBegan) {
  const seif::Pose2 T{2.0, 0.5, 1.0};
  Eigen::Matrix3d Sigma;
  Sigma << 0.04, 0.01, 0.02, 0.01, 0.09, -0.03, 0.02, -0.03, 0.16;
  for (const Eigen::Vector3d& d : {Eigen::Vector3d(1e-5, 0, 0), Eigen::Vector3d(0, 1e-5, 0),
                                   Eigen::Vector3d(0, 0, 1e-5), Eigen::Vector3d(2e-5, -1e-5, 1e-5)}) {
    RecordedGraph graph;
    graph.T_robot_sensor = {0.5, 0.2, 0.3};
    graph.slam.motions = {{1.0, T, Sigma}};
    const seif::Pose2 first{3.0, -1.0, 0.7};
    graph.poses = {first, first * seif::Pose2{T.x + d.x(), T.y + d.y(), T.theta + d.z()}};
    const double expected = d.dot(Sigma.inverse() * d);
    EXPECT_NEAR(squared_error(to_g2o(graph)), expected, 1e-4 * expected) << d.transpose();
    EXPECT_NEAR(squared_error(to_gtsam(graph)), expected, 1e-4 * expected) << d.transpose();
  }
}

TEST(G2o, WhatTheEstimatorDoesNotHaveComesFromWhatWasMeasured) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  write_file(folder / "log" / "filter.tum", "2 3.1 2 0 0 0 0 1\n");
  write_file(folder / "log" / "filter_map.csv", "landmark,x,y,cov_xx,cov_xy,cov_yy\n");
  auto lines = parse(to_g2o(read_graph(folder / "log", "filter")));
  expect_near(lines["VERTEX_SE2"][2], {2, 5.1, 2, 1});
  expect_near(lines["VERTEX_XY"][0], {3, 3.6, 4});
}

TEST(G2o, ARobotThatStandsMakesNoPose) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  write_file(folder / "log" / "odometry.csv",
             "t,dx,dy,dtheta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt\n"
             "1,1,0,0,0.04,0,0,0.01,0,0.1\n3,0,0,0,0,0,0,0,0,0\n");
  auto lines = parse(to_g2o(read_graph(folder / "log", "filter")));
  EXPECT_EQ(lines["VERTEX_SE2"].size(), 2U);
  EXPECT_EQ(lines["EDGE_SE2"].size(), 1U);
  EXPECT_EQ(lines["EDGE_SE2_XY"][2][0], 1.0);
}

/// Reads the file without any code of the exporter. The squared errors of its edges, for the optimum's poses
/// and landmarks, have a chi-square distribution.
TEST(G2o, TheOptimumFitsItsEdges) {
  const TemporaryFolder folder;
  test::run_live(test::small_world(), folder / "run");
  RecordedGraph graph = read_graph(folder / "run", "ekf");
  const FullSlamOptimum best = optimum(graph.slam, graph.poses, graph.landmarks);
  auto lines = parse(to_g2o(graph));
  double sum = 0.0;
  for (const std::vector<double>& edge : lines["EDGE_SE2_XY"]) {
    const seif::Pose2& pose = best.poses.at(static_cast<std::size_t>(edge[0]));
    const auto landmark = static_cast<std::size_t>(edge[1]) - best.poses.size();
    const Eigen::Vector2d error =
        inverse(pose) * best.landmarks.at(landmark) - Eigen::Vector2d(edge[2], edge[3]);
    Eigen::Matrix2d information;
    information << edge[4], edge[5], edge[5], edge[6];
    sum += error.dot(information * error);
  }
  const auto count = static_cast<double>(2 * lines["EDGE_SE2_XY"].size());
  ASSERT_GT(count, 500.0);
  // Fitting removes at most as many degrees of freedom as there are unknowns. Five sigma are added.
  const auto unknowns = static_cast<double>(3 * best.poses.size() + 2 * best.landmarks.size());
  EXPECT_GT(sum, count - unknowns - 5.0 * std::sqrt(2.0 * count));
  EXPECT_LT(sum, count + 5.0 * std::sqrt(2.0 * count));
}

TEST(ReadGraph, NeedsObservationsThatNameTheirLandmarks) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  std::string description = read_file(folder / "log" / "log.yaml");
  description.replace(description.find("known"), 5, "unknown");
  write_file(folder / "log" / "log.yaml", description);
  EXPECT_THROW(read_graph(folder / "log", "filter"), BadInput);
}

TEST(TrajectoriesCsv, HasARowForEachUpdateAndEmptyCellsWhereNothingIsKnown) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  write_file(folder / "log" / "odometry.tum", "2 3 2 0 0 0 0 1\n3 5 2 0 0 0 0 1\n");
  write_file(folder / "log" / "filter.tum", "2 3.1 2 0 0 0 0 1\n");
  write_file(folder / "log" / "truth.csv", "t,x,y,theta\n1,0,0,0\n3,2,0,1\n");
  const std::vector<std::string> names = {"filter"};
  EXPECT_EQ(trajectories_csv(folder / "log", names),
            "t,true_x,true_y,true_theta,odometry_x,odometry_y,odometry_theta,filter_x,filter_y,filter_theta\n"
            "2,1,0,0.5,3,2,0,3.1,2,0\n"
            "3,2,0,1,5,2,0,,,\n");
}

TEST(ExportCommand, WritesEachFormatAndRefusesWhatIsNotThere) {
  const TemporaryFolder folder;
  test::run_live(test::small_world(), folder / "run");
  EXPECT_EQ(test::call(folder, "export run --format tum --estimator truth").output,
            read_file(folder / "run" / "truth.tum"));
  EXPECT_EQ(test::call(folder, "export run --format tum").output, read_file(folder / "run" / "ekf.tum"));
  EXPECT_EQ(test::call(folder, "export run --format csv").output.substr(0, 9), "t,true_x,");
  EXPECT_EQ(test::call(folder, "export run --format g2o --out graph.g2o").exit_code, 0);
  EXPECT_EQ(read_file(folder / "graph.g2o"), to_g2o(read_graph(folder / "run", "ekf")));
  for (const auto& [arguments, complaint] : std::map<std::string, std::string>{
           {"run --format g2o --out graph.g2o", "graph.g2o: is there already"},
           {"run --format g2o --estimator truth", "the run has no 'truth'; it has ekf, seif_report"},
           {"run --format obj", "obj"},
           {"run", "--format"},
           {"nothing --format csv", "nothing/summary.json: cannot be read"}}) {
    const test::Called called = test::call(folder, "export " + arguments);
    EXPECT_EQ(called.exit_code, 2) << arguments;
    EXPECT_NE(called.errors.find(complaint), std::string::npos) << called.errors;
  }
}

}  // namespace
}  // namespace harness
