// The interface of those who follow a run, such as the recorder and the film, and the records that they
// receive.
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

inline constexpr int stage_count = 4;  // [-] number of stages in seif::Stage

/// The time that an update took. [us]
struct UpdateTimes {
  double update = 0.0;                                         // the whole update
  std::array<std::optional<double>, stage_count> stages = {};  // the stages that the filter has
};

/// The state of an estimator after an update: the motion since the last scan, and the scan.
struct UpdateRecord {
  double t = 0.0;                                 // [s]
  seif::Pose2 est_pose;                           // T_world_robot
  std::optional<Eigen::Matrix3d> est_covariance;  // (3 x 3) of the pose, if the filter has it at hand
  std::optional<seif::Pose2> true_pose;           // empty: not known
  seif::Counts counts;                            // the filter's own, after the update
  std::int64_t blocks_touched = 0;                // [-] by this update alone
  UpdateTimes times;
  /// What Estimator::associations() gives, for an estimator that names landmarks by itself. Valid during the
  /// call only.
  std::optional<std::span<const seif::LandmarkId>> associations;
};

/// How well an estimator's belief fits the truth at a scoring time. The NEES are per degree of freedom: a
/// consistent filter has 1.
struct ConsistencyRecord {
  double t = 0.0;                       // [s]
  std::optional<double> nees_pose;      // [-]
  std::optional<double> nees_landmark;  // [-] mean over the landmarks scored
  int landmarks_scored = 0;             // [-]
  int landmarks_mapped = 0;             // [-]
  std::int64_t memory_bytes = 0;        // [byte]
};

/// A landmark of the final map.
struct MapRecord {
  seif::LandmarkId landmark = seif::no_landmark;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // p_world_landmark [m]
  std::optional<Eigen::Matrix2d> covariance;       // (2 x 2) [m^2]
};

/// Receives every event in the order of time. It receives odometry and scans before the estimators process
/// them, then each estimator's update. At scoring times and at the end it also receives the results found
/// then.
class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void odometry(const OdometryEvent& event) = 0;
  virtual void scan(const ScanEvent& event) = 0;
  virtual void dead_reckoning(double /*t*/, const seif::Pose2& /*T_world_robot*/) {}
  virtual void update(std::size_t estimator, const UpdateRecord& record) = 0;
  virtual void consistency(std::size_t /*estimator*/, const ConsistencyRecord& /*record*/) {}
  /// All results of a scoring time have been told.
  virtual void scored() {}
  /// The final map of an estimator.
  virtual void map(std::size_t /*estimator*/, std::span<const MapRecord> /*landmarks*/) {}
};

}  // namespace harness
