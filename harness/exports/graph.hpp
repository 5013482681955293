// The measurements of a run as a graph that other SLAM programs can optimise.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/estimators/full_slam.hpp"

namespace harness {

/// A recorded stream as a full SLAM problem, with an estimator's results as the initial guess.
struct RecordedGraph {
  FullSlam slam;
  seif::Pose2 T_robot_sensor;
  std::vector<seif::Pose2> poses;          // T_world_robot, one for each pose of the problem
  std::vector<Eigen::Vector2d> landmarks;  // p_world_landmark [m]
  std::vector<seif::LandmarkId> ids;       // of `landmarks`
};

/// Poses are those after the estimator's updates, landmarks those of its final map. If the estimator was
/// removed from the run, missing poses come from odometry, and missing landmarks from their first
/// observation. Throws BadInput.
RecordedGraph read_graph(const std::filesystem::path& run, const std::string& estimator);

/// The graph for g2o: VERTEX_SE2 from 0, VERTEX_XY after them in the order in which the landmarks were first
/// seen, EDGE_SE2, EDGE_SE2_XY, and the first pose fixed.
std::string to_g2o(const RecordedGraph& graph);

/// The graph for GTSAM's readG2o, which ignores EDGE_SE2_XY. Landmarks are written as BR, bearing and range,
/// from a VERTEX_SE2. So the poses and motions are those of the sensor.
std::string to_gtsam(const RecordedGraph& graph);

}  // namespace harness
