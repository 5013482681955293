#include "harness/exports/graph.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <iterator>
#include <map>
#include <span>
#include <utility>

#include "harness/score/score_folder.hpp"
#include "harness/stream/log_stream.hpp"
#include "seif/models.hpp"

namespace harness {

namespace {

/// Builds the graph from a stream. Poses and landmarks get the values of an estimator.
class GraphBuilder {
 public:
  GraphBuilder(const LogDescription& log, std::vector<TimedPose> trajectory,
               const std::vector<MapRecord>& map)
      : T_robot_sensor_(log.T_robot_sensor), trajectory_(std::move(trajectory)) {
    graph_.slam.start = log.start;
    graph_.T_robot_sensor = log.T_robot_sensor;
    graph_.poses.push_back(log.start.mean);
    for (const MapRecord& landmark : map) map_[landmark.landmark] = landmark.mean;
  }

  void take(const OdometryEvent& event) { motion_ = compose(motion_, event.odometry); }

  void take(const ScanEvent& event) {
    // As in the optimum: without motion there is no new pose.
    if (!is_certain(motion_)) add_pose();
    ++scans_;
    const seif::Pose2 T_pose_sensor = motion_.T_previous_current * T_robot_sensor_;
    for (const seif::Observation& observation : event.scan.observations)
      graph_.slam.sightings.push_back(
          {graph_.slam.pose_count() - 1, number_of(observation), T_pose_sensor, observation});
  }

  RecordedGraph graph() && { return std::move(graph_); }

 private:
  void add_pose() {
    const bool is_known = scans_ < trajectory_.size();
    graph_.poses.push_back(is_known ? trajectory_[scans_].T_world_robot
                                    : graph_.poses.back() * motion_.T_previous_current);
    graph_.slam.motions.push_back(std::exchange(motion_, {}));
  }

  /// The number of a landmark. A new landmark gets the next number.
  int number_of(const seif::Observation& observation) {
    const auto [number, is_new] = numbers_.try_emplace(observation.landmark, graph_.slam.landmark_count);
    if (!is_new) return number->second;
    const auto mapped = map_.find(observation.landmark);
    graph_.ids.push_back(observation.landmark);
    graph_.landmarks.push_back(mapped != map_.end() ? mapped->second : seen_at(observation));
    return graph_.slam.landmark_count++;
  }

  Eigen::Vector2d seen_at(const seif::Observation& observation) const {
    const seif::Pose2 T_world_robot = graph_.poses.back() * motion_.T_previous_current;
    return seif::invert_observation(T_world_robot, T_robot_sensor_, observation).p_world_landmark;
  }

  seif::Pose2 T_robot_sensor_;
  std::vector<TimedPose> trajectory_;  // one for each scan
  std::map<seif::LandmarkId, Eigen::Vector2d> map_;
  std::map<seif::LandmarkId, int> numbers_;
  std::size_t scans_ = 0;  // [-] so far
  seif::Odometry motion_;  // since the last pose
  RecordedGraph graph_;
};

/// The upper triangle, row by row.
template <class Matrix>
void add_information(const Matrix& information, std::string& text) {
  for (Eigen::Index i = 0; i < information.rows(); ++i) {
    for (Eigen::Index j = i; j < information.cols(); ++j)
      fmt::format_to(std::back_inserter(text), " {}", information(i, j));
  }
  text += '\n';
}

void add_pose(const seif::Pose2& pose, std::string& text) {
  fmt::format_to(std::back_inserter(text), " {} {} {}", pose.x, pose.y, pose.theta);
}

void add_vertices(std::span<const seif::Pose2> poses, std::span<const Eigen::Vector2d> landmarks,
                  std::string& text) {
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    fmt::format_to(out, "VERTEX_SE2 {}", i);
    add_pose(poses[i], text);
    text += '\n';
  }
  for (std::size_t j = 0; j < landmarks.size(); ++j)
    fmt::format_to(out, "VERTEX_XY {} {} {}\n", poses.size() + j, landmarks[j].x(), landmarks[j].y());
}

/// g2o's error of an edge is the error of its end, in the frame of the measured end. Our covariance is in the
/// frame of the beginning, so it is turned by the measured motion.
void add_motion(int from, const seif::Odometry& motion, std::string& text) {
  fmt::format_to(std::back_inserter(text), "EDGE_SE2 {} {}", from, from + 1);
  add_pose(motion.T_previous_current, text);
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // R_begin_end
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(motion.T_previous_current.theta).toRotationMatrix();
  add_information(Eigen::Matrix3d(R.transpose() * information_of_motion(motion.covariance) * R), text);
}

/// The motion of a sensor that is fixed to a robot, with its covariance to first order. If the robot has the
/// error (d, phi), the sensor at p on the robot has the error d + R'(theta) p phi.
seif::Odometry motion_of_sensor(const seif::Odometry& motion, const seif::Pose2& T_robot_sensor) {
  const seif::Pose2& T = motion.T_previous_current;
  const Eigen::Matrix2d R_sensor_robot = Eigen::Rotation2Dd(-T_robot_sensor.theta).toRotationMatrix();
  const Eigen::Vector2d p = Eigen::Rotation2Dd(T.theta) * Eigen::Vector2d(T_robot_sensor.x, T_robot_sensor.y);
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J.topLeftCorner<2, 2>() = R_sensor_robot;
  J.topRightCorner<2, 1>() = R_sensor_robot * Eigen::Vector2d(-p.y(), p.x());
  return {motion.t, inverse(T_robot_sensor) * T * T_robot_sensor, J * motion.covariance * J.transpose()};
}

/// An observation as bearing and range from the vertex of a sensor's pose. The sensor observes from
/// T_vertex_sensor. This is the identity unless the robot has moved since by a motion that is known exactly.
void add_bearing_and_range(const Sighting& sighting, const seif::Pose2& T_vertex_sensor, int landmark,
                           std::string& text) {
  const seif::InverseObservation seen = seif::invert_observation({}, T_vertex_sensor, sighting.observation);
  const seif::PredictedObservation from_vertex = seif::predict_observation({}, {}, seen.p_world_landmark);
  const Eigen::Matrix2d J = from_vertex.J_wrt_landmark * seen.J_wrt_observation;
  const Eigen::Vector2d sd = (J * sighting.observation.covariance * J.transpose()).diagonal().cwiseSqrt();
  fmt::format_to(std::back_inserter(text), "BR {} {} {} {} {} {}\n", sighting.pose, landmark,
                 from_vertex.z(1), from_vertex.z(0), sd(1), sd(0));
}

/// Range and bearing as a point in the frame of the pose, with its covariance to first order.
void add_sighting(const Sighting& sighting, int landmark, std::string& text) {
  const seif::InverseObservation inverse =
      seif::invert_observation({}, sighting.T_pose_sensor, sighting.observation);
  const Eigen::Matrix2d& J = inverse.J_wrt_observation;
  const Eigen::Matrix2d covariance = J * sighting.observation.covariance * J.transpose();
  const Eigen::Vector2d& p = inverse.p_world_landmark;
  fmt::format_to(std::back_inserter(text), "EDGE_SE2_XY {} {} {} {}", sighting.pose, landmark, p.x(), p.y());
  add_information(Eigen::Matrix2d(covariance.inverse()), text);  // of fixed size, so inverse() is safe
}

}  // namespace

RecordedGraph read_graph(const std::filesystem::path& run, const std::string& estimator) {
  LogStream stream(run);
  if (!stream.description().known_association)
    throw BadInput(fmt::format(
        "{}: its observations do not say which landmark they are of, so there is no graph", run.string()));
  GraphBuilder builder(stream.description(), read_trajectory(run, estimator), read_map(run, estimator));
  for (Event event; stream.next(event);) std::visit([&](const auto& e) { builder.take(e); }, event);
  return std::move(builder).graph();
}

std::string to_g2o(const RecordedGraph& graph) {
  std::string text;
  add_vertices(graph.poses, graph.landmarks, text);
  text += "FIX 0\n";
  for (int i = 0; const seif::Odometry& motion : graph.slam.motions) add_motion(i++, motion, text);
  for (const Sighting& sighting : graph.slam.sightings)
    add_sighting(sighting, graph.slam.pose_count() + sighting.landmark, text);
  return text;
}

std::string to_gtsam(const RecordedGraph& graph) {
  std::vector<seif::Pose2> poses = graph.poses;
  for (seif::Pose2& pose : poses) pose = pose * graph.T_robot_sensor;
  std::string text;
  add_vertices(poses, graph.landmarks, text);
  for (int i = 0; const seif::Odometry& motion : graph.slam.motions)
    add_motion(i++, motion_of_sensor(motion, graph.T_robot_sensor), text);
  const seif::Pose2 T_sensor_robot = inverse(graph.T_robot_sensor);
  for (const Sighting& sighting : graph.slam.sightings) {
    add_bearing_and_range(sighting, T_sensor_robot * sighting.T_pose_sensor,
                          graph.slam.pose_count() + sighting.landmark, text);
  }
  return text;
}

}  // namespace harness
