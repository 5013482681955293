// The least-squares optimum of everything measured so far, as a reference for the filters.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "harness/estimators/full_slam.hpp"
#include "seif/estimator.hpp"
#include "seif/landmark_index.hpp"
#include "seif/marginals.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Stores all data, and solves for all poses and landmarks when the map is asked for: neither in constant time
/// nor in constant memory. On the live path its pose is that of its guide, a filter whose map is the first guess.
/// Each solution starts anew, so that the optimum depends on the data alone. Its links are the observations:
/// poses stay in the graph, so landmarks are linked to them and not to each other.
class Batch final : public seif::Estimator {
 public:
  /// `guide` is made from the same set-up, and refuses it if the start covariance is not positive definite.
  /// Sightings more than `robust_above` [sigma] off get less weight. 0: never.
  Batch(const seif::EstimatorSetup& setup, std::unique_ptr<seif::Estimator> guide, double robust_above = 0.0);

  void motion_update(const seif::Odometry& odometry) override;
  void measurement_update(const seif::Scan& scan, const seif::StageDone& done) override;
  seif::Pose2 pose() const override;  // the optimum's, if it was solved for since the last update
  seif::Counts counts() const override;
  std::size_t memory_bytes() const override;

  /// The guide's, unless the optimum was computed since the last update: a few landmarks are not worth a solution.
  void landmarks(std::span<const seif::LandmarkId> landmarks,
                 std::vector<seif::LandmarkEstimate>& out) const override;

  /// These two throw std::runtime_error if no optimum is found.
  std::vector<seif::LandmarkEstimate> map() const override;
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId> landmarks) const override;

  /// Nothing unless the optimum was computed since the last update.
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const seif::LandmarkIds> groups) const override;

  /// The optimum's poses at all scans so far. Throws as map() does.
  std::vector<seif::Pose2> trajectory() const;

 private:
  /// The solution, until more data come.
  struct Solved {
    FullSlamOptimum optimum;
    std::optional<seif::DiagonalBlocksOfInverse> Sigma;  // nothing: not positive definite
  };

  /// The robot's pose at a scan.
  struct ScanPose {
    int pose = 0;  // the number of the pose before it
    seif::Pose2 T_pose_robot;
  };

  int landmark_number(seif::LandmarkId landmark);
  const Solved& solved() const;

  std::unique_ptr<seif::Estimator> guide_;
  seif::Pose2 T_robot_sensor_;
  FullSlam slam_;
  seif::Odometry since_last_pose_;  // not yet a motion of slam_
  std::vector<ScanPose> scan_poses_;
  std::vector<seif::LandmarkId> ids_;  // by number
  seif::LandmarkIndex index_;
  int active_landmarks_ = 0;  // [-] in the latest scan
  mutable std::optional<Solved> solved_;
};

/// `batch`, with its guide made from a type of `registry`.
seif::EstimatorType batch_estimator(const seif::Registry& registry);

}  // namespace harness
