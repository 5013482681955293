// The measurements of a run as a graph for other SLAM programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/estimators/full_slam.hpp"

namespace harness {

/// A recorded stream as a full SLAM problem, and the first guess that an estimator's results are.
struct RecordedGraph {
  FullSlam slam;
  seif::Pose2 T_robot_sensor;
  std::vector<seif::Pose2> poses;          // T_world_robot, one for each of the problem's
  std::vector<Eigen::Vector2d> landmarks;  // p_world_landmark [m]
  std::vector<seif::LandmarkId> ids;       // of the landmarks
};

/// The first guess has the estimator's poses after its updates, and the landmarks of its final map. If the estimator
/// was taken out of the run, the rest comes from odometry and first sightings. Throws BadInput.
RecordedGraph read_graph(const std::filesystem::path& run, const std::string& estimator);

/// As g2o reads it: VERTEX_SE2 from 0, VERTEX_XY behind them in the order in which the landmarks were first
/// seen, EDGE_SE2, EDGE_SE2_XY, and the first pose fixed.
std::string to_g2o(const RecordedGraph& graph);

/// As GTSAM's readG2o reads it, which passes over EDGE_SE2_XY: landmarks by BR, bearing and range. These are
/// relative to a VERTEX_SE2, so poses and motions are those of the sensor.
std::string to_gtsam(const RecordedGraph& graph);

}  // namespace harness
