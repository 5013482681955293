// The listeners of a run, such as the recorder or a film, and the records that they get.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "harness/stream/stream.hpp"
#include "seif/counts.hpp"

namespace harness {

inline constexpr int stage_count = 4;  // [-] of seif::Stage

/// What an update cost. [us]
struct UpdateTimes {
  double update = 0.0;                                         // all of it
  std::array<std::optional<double>, stage_count> stages = {};  // those that the filter has
};

/// An estimator after an update: the motion since the last scan, and the scan.
struct UpdateRecord {
  double t = 0.0;                                 // [s]
  seif::Pose2 est_pose;                           // T_world_robot
  std::optional<Eigen::Matrix3d> est_covariance;  // (3 x 3) of the pose, where the filter has it at hand
  std::optional<seif::Pose2> true_pose;           // where it is known
  seif::Counts counts;                            // the filter's own, after the update
  std::int64_t blocks_touched = 0;                // [-] by this update alone
  UpdateTimes times;
  /// Estimator::associations() of an estimator that associates by itself. Valid during the call.
  std::optional<std::span<const seif::LandmarkId>> associations;
};

/// How well an estimator's belief fits the truth, at a scoring time. NEES per degree of freedom: 1 is right.
struct ConsistencyRecord {
  double t = 0.0;                       // [s]
  std::optional<double> nees_pose;      // [-]
  std::optional<double> nees_landmark;  // [-] mean over the landmarks scored
  int landmarks_scored = 0;             // [-]
  int landmarks_mapped = 0;             // [-]
  std::int64_t memory_bytes = 0;        // [byte]
};

/// A landmark of a finished map.
struct MapRecord {
  seif::LandmarkId landmark = seif::no_landmark;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // p_world_landmark [m]
  std::optional<Eigen::Matrix2d> covariance;       // (2 x 2) [m^2]
};

/// Gets everything in the order in which it happens: odometry and scans before any estimator does, then each
/// estimator's update with the scan; scores at the scoring times, and maps at the end.
class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void odometry(const OdometryEvent& event) = 0;
  virtual void scan(const ScanEvent& event) = 0;
  virtual void dead_reckoning(double /*t*/, const seif::Pose2& /*T_world_robot*/) {}
  virtual void update(std::size_t estimator, const UpdateRecord& record) = 0;
  virtual void consistency(std::size_t /*estimator*/, const ConsistencyRecord& /*record*/) {}
  /// A scoring time is over.
  virtual void scored() {}
  /// The map of an estimator, once, at the end.
  virtual void map(std::size_t /*estimator*/, std::span<const MapRecord> /*landmarks*/) {}
};

}  // namespace harness
