// Graphs of poses and landmarks as text files of iSAM and g2o, with edges in the order of time.
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

/// A motion from one pose to the next, or a landmark as seen from a pose. The numbers are those of the file.
struct GraphEdge {
  std::int64_t from = 0;  // number of a pose
  std::int64_t to = 0;    // number of the next pose, or of the landmark
  seif::Pose2 T_from_to;  // for a motion
  Eigen::Vector2d p_from_landmark = Eigen::Vector2d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // for a motion
  Eigen::Matrix2d point_covariance = Eigen::Matrix2d::Zero();
};

/// Reads the motions of a file, or its observations of landmarks, one by one. Throws BadInput for a malformed
/// row, and for a motion that does not start where the one before it ended.
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
  std::optional<std::int64_t> pose_;  // the last pose of the last edge
  std::int64_t not_finite_ = 0;
};

/// A graph has no times, so a step counts as a second. Landmarks are converted to range and bearing, with
/// covariances to first order. Pose and map start at the origin. Motions and observations may be mixed in one
/// file, but each kind must be in order: two passes through the file at the same time then need no memory for
/// it.
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
  std::unique_ptr<GraphEdges> true_motions_;  // null: the truth is not known
  std::optional<GraphEdge> next_motion_;
  std::optional<GraphEdge> next_landmark_;
  std::int64_t pose_ = 0;  // number of the present pose
  double t_ = 0.0;         // [s]
  std::optional<TruePose> true_pose_;
  ScanMemory memory_;
};

}  // namespace harness
