// Graphs of poses and landmarks as text, in the order of time: the formats of iSAM and g2o.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "harness/files/row_reader.hpp"
#include "harness/stream/recorded_log.hpp"

namespace harness {

/// A motion from one pose to the next, or a landmark as seen from a pose; the numbers are the file's.
struct GraphEdge {
  std::int64_t from = 0;  // a pose
  std::int64_t to = 0;    // the next pose, or the landmark
  seif::Pose2 T_from_to;  // of a motion
  Eigen::Vector2d p_from_landmark = Eigen::Vector2d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of a motion
  Eigen::Matrix2d point_covariance = Eigen::Matrix2d::Zero();
};

/// The motions of a file, or the landmarks that were seen, one by one. Throws BadInput for malformed rows,
/// and for a motion that does not begin where the previous one ended.
class GraphEdges {
 public:
  enum class Kind { motions, landmarks };

  GraphEdges(const std::filesystem::path& file, Kind kind);

  std::optional<GraphEdge> next();

  std::int64_t not_finite() const { return not_finite_; }  // landmarks with a NaN, left out
  [[noreturn]] void fail(std::size_t cell, const std::string& reason) const { rows_.fail(cell, reason); }

 private:
  std::optional<GraphEdge> read_edge();
  GraphEdge motion(bool is_isam) const;
  GraphEdge landmark(bool is_square_root) const;

  RowReader rows_;
  Kind kind_;
  std::optional<std::int64_t> pose_;  // where the last edge led, or began
  std::int64_t not_finite_ = 0;
};

/// A step is a second: graphs have no times. Landmarks are turned into ranges and bearings, their covariances
/// to first order. Pose and map begin at the origin. Motions and observations may stand in one file in any
/// mixture, but each in its order, so that two passes through the file at the same time need no memory.
class PoseLandmarkGraph final : public RecordedLog {
 public:
  /// `truth`, if given, is the same graph without noise. All functions throw BadInput.
  PoseLandmarkGraph(const std::filesystem::path& file, const std::optional<std::filesystem::path>& truth);

  const LogDescription& description() const override { return description_; }
  bool next(Event& event) override;
  ReadCounts counts() const override;

 private:
  void read_true_landmarks(const std::filesystem::path& file);
  void fill(ScanEvent& event);
  void move_truth(const GraphEdge& motion);

  LogDescription description_;
  ReadCounts counts_;
  GraphEdges motions_;
  GraphEdges landmarks_;
  std::unique_ptr<GraphEdges> true_motions_;  // where there is a truth
  std::optional<GraphEdge> next_motion_;
  std::optional<GraphEdge> next_landmark_;
  std::int64_t pose_ = 0;  // the present one's number
  double t_ = 0.0;         // [s]
  std::optional<TruePose> true_pose_;
  ScanMemory memory_;
};

}  // namespace harness
