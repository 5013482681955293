// The least-squares optimum of everything measured so far, the reference for all filters.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "harness/estimators/full_slam.hpp"
#include "seif/estimator.hpp"
#include "seif/landmark_index.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Keeps all data, and solves for all poses and landmarks when the map is asked for. Time and memory are not
/// constant. Between solutions its pose is that of its guide: a filter on the same data whose map is the
/// starting point of the optimisation. Each solution starts from the guide again, so the optimum depends on
/// the data only, and not on earlier solutions. Its links are the observations: poses stay in the graph, so
/// landmarks are linked to poses and not to each other.
class Batch final : public seif::Estimator {
 public:
  /// `guide` is made with the same setup; it throws if the start covariance is not positive definite.
  /// Sightings with a residual above `robust_above` [sigma] count less; 0: all count fully.
  Batch(const seif::EstimatorSetup& setup, std::unique_ptr<seif::Estimator> guide, double robust_above = 0.0);

  void motion_update(const seif::Odometry& odometry) override;
  void measurement_update(const seif::Scan& scan, const seif::StageDone& done) override;
  seif::Pose2 pose() const override;  // of the optimum, if solved since the last update
  seif::Counts counts() const override;
  std::size_t memory_bytes() const override;

  /// The guide's landmarks, unless solved since the last update. Reading a few landmarks does not start a
  /// solution.
  void landmarks(std::span<const seif::LandmarkId> landmarks,
                 std::vector<seif::LandmarkEstimate>& out) const override;

  /// Both throw std::runtime_error if no optimum is found.
  std::vector<seif::LandmarkEstimate> map() const override;
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId> landmarks) const override;

  /// Empty unless solved since the last update.
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const seif::LandmarkIds> groups) const override;

  /// The optimal poses at all scans so far. Throws as map() does.
  std::vector<seif::Pose2> trajectory() const;

 private:
  /// The robot's pose at a scan.
  struct ScanPose {
    int pose = 0;  // number of the last pose before the scan
    seif::Pose2 T_pose_robot;
  };

  int landmark_number(seif::LandmarkId landmark);
  const FullSlamOptimum& solved() const;

  std::unique_ptr<seif::Estimator> guide_;
  seif::Pose2 T_robot_sensor_;
  FullSlam slam_;
  seif::Odometry since_last_pose_;  // not yet a motion in slam_
  std::vector<ScanPose> scan_poses_;
  std::vector<seif::LandmarkId> ids_;  // by number
  seif::LandmarkIndex index_;
  int active_landmarks_ = 0;                       // [-] in the latest scan
  mutable std::optional<FullSlamOptimum> solved_;  // dropped when new data arrives
};

/// The estimator type `batch`. Its guide is made from a type of `registry`.
seif::EstimatorType batch_estimator(const seif::Registry& registry);

}  // namespace harness
