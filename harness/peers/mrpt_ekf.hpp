// MRPT's range-bearing EKF-SLAM as an estimator of ours, in a plug-in.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "harness/peers/mrpt_filter/mrpt_filter.hpp"
#include "seif/estimator.hpp"
#include "seif/landmark_index.hpp"

namespace peers {

/// Uses the stream's own covariances of the motions. MRPT has one measurement noise for a whole scan: the
/// mean of the observations' variances. MRPT processes motions only together with a scan that sees a
/// landmark; until then they are accumulated here. It counts no blocks.
class MrptEkf final : public seif::Estimator {
 public:
  explicit MrptEkf(std::unique_ptr<MrptFilter> filter) : filter_(std::move(filter)) {}

  void motion_update(const seif::Odometry& odometry) override;
  void measurement_update(const seif::Scan& scan, const seif::StageDone& done) override;
  seif::Pose2 pose() const override;
  std::optional<Eigen::Matrix3d> pose_covariance() const override;
  seif::Counts counts() const override;
  std::size_t memory_bytes() const override;
  std::vector<seif::LandmarkEstimate> map() const override;
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId> landmarks) const override;
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const seif::LandmarkIds> groups) const override;

 private:
  seif::Pose2 last_pose() const;  // at the last scan that saw a landmark
  int row_of(seif::LandmarkId landmark) const { return 3 + 2 * index_.find(landmark).value(); }
  Eigen::MatrixXd covariance(const std::vector<int>& rows) const;

  std::unique_ptr<MrptFilter> filter_;
  seif::Odometry since_;               // the motion since then, not yet processed
  std::vector<seif::LandmarkId> ids_;  // in the order of its state
  seif::LandmarkIndex index_;
  std::vector<Sighting> seen_;  // reused from scan to scan
};

}  // namespace peers
