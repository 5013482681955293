#include "harness/readers/pose_landmark_graph.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <string_view>
#include <variant>
#include <vector>

#include "harness/readers/landmark_rows.hpp"
#include "seif/models.hpp"

namespace harness {

namespace {

constexpr double graph_start_sd = 1e-3;  // [m, rad] the frame is that of the first pose

/// An upper triangle, row by row, with zeros below.
template <int Size>
Eigen::Matrix<double, Size, Size> upper_triangle(const RowReader& rows, std::size_t cell) {
  Eigen::Matrix<double, Size, Size> matrix = Eigen::Matrix<double, Size, Size>::Zero();
  for (int i = 0; i < Size; ++i) {
    for (int j = i; j < Size; ++j) matrix(i, j) = rows.number(cell++, "information");
  }
  return matrix;
}

/// Symmetric to the bit. Of a covariance only the upper triangle is recorded, and a replay must use the same
/// numbers.
template <int Size>
Eigen::Matrix<double, Size, Size> symmetric(const Eigen::Matrix<double, Size, Size>& covariance) {
  return 0.5 * (covariance + covariance.transpose());
}

/// The covariance from the information matrix, or from R, where R' R is the information matrix.
template <int Size>
Eigen::Matrix<double, Size, Size> covariance_of(const RowReader& rows, std::size_t cell,
                                                bool is_square_root) {
  using Matrix = Eigen::Matrix<double, Size, Size>;
  const Matrix upper = upper_triangle<Size>(rows, cell);
  Matrix Omega = upper.template selfadjointView<Eigen::Upper>();
  if (is_square_root) Omega = upper.transpose() * upper;
  const Eigen::LLT<Matrix> llt(Omega);
  if (llt.info() != Eigen::Success) rows.fail(cell, "information: is not positive definite");
  const Matrix covariance = symmetric<Size>(llt.solve(Matrix::Identity()));
  if (!covariance.allFinite()) rows.fail(cell, "information: has no inverse");
  return covariance;
}

/// g2o gives the error of a motion in the frame of its end. iSAM gives it in the frame of its beginning, as
/// we do.
Eigen::Matrix3d turned(const Eigen::Matrix3d& covariance, double theta) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // R_begin_end
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(theta).toRotationMatrix();
  return symmetric<3>(R * covariance * R.transpose());
}

bool is_vertex(std::string_view word) { return word.starts_with("VERTEX") || word == "FIX"; }
bool is_isam_motion(std::string_view word) { return word == "ODOMETRY" || word == "EDGE2"; }

/// Converts a point to range and bearing, with the covariance to first order.
seif::Observation observation_of(const GraphEdge& edge) {
  const seif::PredictedObservation seen = seif::predict_observation({}, {}, edge.p_from_landmark);
  const Eigen::Matrix2d& J = seen.J_wrt_landmark;
  return {static_cast<seif::LandmarkId>(edge.to), seen.z(0), seen.z(1),
          symmetric<2>(J * edge.point_covariance * J.transpose())};
}

}  // namespace

GraphEdges::GraphEdges(const std::filesystem::path& file, Kind kind) : rows_(file, ' '), kind_(kind) {}

std::optional<GraphEdge> GraphEdges::next() {
  while (std::optional<GraphEdge> edge = read_edge()) {
    const bool is_motion = kind_ == Kind::motions;
    if (is_motion && pose_ && edge->from != *pose_)
      rows_.fail(1,
                 fmt::format("pose {} is not where the motion before it ended, {}: edges that close a loop "
                             "between poses are no odometry",
                             edge->from, *pose_));
    if (is_motion && edge->to <= edge->from) rows_.fail(2, "a motion must lead to a pose of a larger number");
    if (!is_motion && pose_ && edge->from < *pose_)
      rows_.fail(1, fmt::format("pose {} comes after pose {}; observations must be in the order of the poses",
                                edge->from, *pose_));
    pose_ = is_motion ? edge->to : edge->from;
    if (edge->p_from_landmark.allFinite()) return edge;
    ++not_finite_;
  }
  return std::nullopt;
}

/// The next edge of the wanted kind. Rows of the other kind are skipped.
std::optional<GraphEdge> GraphEdges::read_edge() {
  while (rows_.next()) {
    const std::string_view word = rows_.cell(0);
    if (word.empty() || rows_.is_comment() || is_vertex(word)) continue;
    const bool is_motion = is_isam_motion(word) || word == "EDGE_SE2";
    const bool is_landmark = word == "LANDMARK" || word == "EDGE_SE2_XY";
    if (!is_motion && !is_landmark)
      rows_.fail(0, fmt::format("'{}' is no record of a graph of poses and landmarks", word));
    const std::size_t cells = is_motion ? 12 : 8;
    if (rows_.size() > cells)
      rows_.fail(cells, fmt::format("the record has {} values, there are {}", rows_.size(), cells));
    if (is_motion && kind_ == Kind::motions) return motion(is_isam_motion(word));
    if (is_landmark && kind_ == Kind::landmarks) return landmark(word == "LANDMARK");
  }
  return std::nullopt;
}

GraphEdge GraphEdges::motion(bool is_isam) const {
  GraphEdge edge;
  edge.from = rows_.integer(1, "pose", 0, largest_id);
  edge.to = rows_.integer(2, "next pose", 0, largest_id);
  edge.T_from_to = {rows_.number(3, "dx"), rows_.number(4, "dy"),
                    seif::wrap_angle(rows_.number(5, "dtheta"))};
  edge.covariance = covariance_of<3>(rows_, 6, is_isam);
  if (!is_isam) edge.covariance = turned(edge.covariance, edge.T_from_to.theta);
  return edge;
}

GraphEdge GraphEdges::landmark(bool is_square_root) const {
  GraphEdge edge;
  edge.from = rows_.integer(1, "pose", 0, largest_id);
  edge.to = rows_.integer(2, "landmark", 0, largest_id);
  edge.p_from_landmark = {rows_.number(3, "x", Finite::not_required),
                          rows_.number(4, "y", Finite::not_required)};
  edge.point_covariance = covariance_of<2>(rows_, 5, is_square_root);
  return edge;
}

PoseLandmarkGraph::PoseLandmarkGraph(const std::filesystem::path& file,
                                     const std::optional<std::filesystem::path>& truth)
    : motions_(file, GraphEdges::Kind::motions), landmarks_(file, GraphEdges::Kind::landmarks) {
  description_.name = file.stem().string();
  description_.noise = {1.0, 0.0, 1.0};  // every observation has its own covariance
  description_.start.covariance = graph_start_sd * graph_start_sd * Eigen::Matrix3d::Identity();
  next_motion_ = motions_.next();
  next_landmark_ = landmarks_.next();
  if (!next_motion_) throw BadInput(fmt::format("{}: there is no motion in it", file.string()));
  pose_ = next_motion_->from;
  if (next_landmark_ && next_landmark_->from < pose_)
    landmarks_.fail(1, fmt::format("pose {} is before the first one, {}", next_landmark_->from, pose_));
  if (!truth) return;
  read_true_landmarks(*truth);
  true_motions_ = std::make_unique<GraphEdges>(*truth, GraphEdges::Kind::motions);
  true_pose_ = TruePose{};
  description_.has_truth = true;
  description_.true_start = true_pose_;
}

/// Places each true landmark where it is first seen.
void PoseLandmarkGraph::read_true_landmarks(const std::filesystem::path& file) {
  PoseLandmarkGraph graph(file, std::nullopt);
  std::map<seif::LandmarkId, Eigen::Vector2d> landmarks;
  seif::Pose2 pose;
  for (Event event; graph.next(event);) {
    if (const auto* odometry = std::get_if<OdometryEvent>(&event))
      pose = pose * odometry->odometry.T_previous_current;
    if (const auto* scan = std::get_if<ScanEvent>(&event)) {
      for (const seif::Observation& observation : scan->scan.observations)
        landmarks.try_emplace(observation.landmark,
                              seif::invert_observation(pose, {}, observation).p_world_landmark);
    }
  }
  std::vector<TrueLandmark>& all = description_.landmarks.emplace();
  for (const auto& [id, position] : landmarks) all.push_back({id, position, 0.0});
}

ReadCounts PoseLandmarkGraph::counts() const {
  ReadCounts counts = counts_;
  counts.not_finite += landmarks_.not_finite();
  return counts;
}

bool PoseLandmarkGraph::next(Event& event) {
  if (next_landmark_ && next_landmark_->from == pose_) {
    fill(memory_.scan(event));
    return true;
  }
  if (!next_motion_) {
    if (next_landmark_) landmarks_.fail(1, fmt::format("no motion leads to pose {}", next_landmark_->from));
    return false;
  }
  if (next_landmark_ && next_landmark_->from < next_motion_->to)
    landmarks_.fail(1, fmt::format("no motion leads to pose {}", next_landmark_->from));
  move_truth(*next_motion_);
  pose_ = next_motion_->to;
  t_ += 1.0;
  if (true_pose_) true_pose_->t = t_;
  OdometryEvent& odometry = memory_.odometry(event);
  odometry.odometry = {t_, next_motion_->T_from_to, next_motion_->covariance};
  odometry.truth = true_pose_;
  next_motion_ = motions_.next();
  return true;
}

void PoseLandmarkGraph::move_truth(const GraphEdge& motion) {
  if (!true_motions_) return;
  const std::optional<GraphEdge> truth = true_motions_->next();
  if (!truth || truth->from != motion.from || truth->to != motion.to)
    throw BadInput(fmt::format("the truth has no motion from pose {} to pose {} where the log has one",
                               motion.from, motion.to));
  true_pose_->T_world_robot = true_pose_->T_world_robot * truth->T_from_to;
}

void PoseLandmarkGraph::fill(ScanEvent& event) {
  begin_scan(event, t_, true_pose_);
  for (; next_landmark_ && next_landmark_->from == pose_; next_landmark_ = landmarks_.next())
    add_once(observation_of(*next_landmark_), event, counts_);
}

}  // namespace harness
