#include "harness/peers/mrpt_ekf.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "harness/peers/mrpt_ekf_type.hpp"
#include "seif/marginals.hpp"
#include "seif/models.hpp"
#include "seif/plugin.hpp"

namespace peers {

namespace {

Gaussian gaussian_of(const seif::Pose2& pose, const Eigen::Matrix3d& covariance) {
  Gaussian gaussian{.mean = {pose.x, pose.y, pose.theta}, .covariance = {}};
  Eigen::Map<Eigen::Matrix3d>(gaussian.covariance.data()) = covariance;
  return gaussian;
}

SensorNoise noise_of(const seif::Scan& scan) {
  Eigen::Vector2d variances = Eigen::Vector2d::Zero();
  for (const seif::Observation& observation : scan.observations)
    variances += observation.covariance.diagonal();
  variances /= static_cast<double>(scan.observations.size());
  return {std::sqrt(variances(0)), std::sqrt(variances(1))};
}

}  // namespace

void MrptEkf::motion_update(const seif::Odometry& odometry) { since_ = compose(since_, odometry); }

void MrptEkf::measurement_update(const seif::Scan& scan, const seif::StageDone& done) {
  if (!scan.observations.empty()) {
    seen_.clear();
    for (const seif::Observation& observation : scan.observations)
      seen_.push_back({observation.landmark, observation.range, observation.bearing});
    const seif::Odometry motion = std::exchange(since_, {});
    filter_->update(gaussian_of(motion.T_previous_current, motion.covariance), seen_, noise_of(scan));
    while (3 + 2 * ids_.size() < filter_->mean().size()) {
      const auto place = static_cast<int>(ids_.size());
      ids_.push_back(filter_->landmark_at(place));
      index_.insert(ids_.back(), place);
    }
  }
  done(seif::Stage::measurement);
}

seif::Pose2 MrptEkf::last_pose() const {
  const std::span<const double> mean = filter_->mean();
  return {mean[0], mean[1], mean[2]};
}

seif::Pose2 MrptEkf::pose() const { return last_pose() * since_.T_previous_current; }

std::optional<Eigen::Matrix3d> MrptEkf::pose_covariance() const {
  Eigen::MatrixXd Sigma = covariance({0, 1, 2});
  move_pose(Sigma, last_pose(), since_);
  return Sigma;
}

seif::Counts MrptEkf::counts() const {
  const auto count = static_cast<std::int64_t>(ids_.size());
  return {.active_landmarks = static_cast<int>(count), .links = count + count * (count - 1) / 2};
}

std::size_t MrptEkf::memory_bytes() const {
  const std::size_t size = filter_->mean().size();
  return (size + size * size) * sizeof(double) + ids_.capacity() * sizeof(ids_[0]) + index_.memory_bytes();
}

std::vector<seif::LandmarkEstimate> MrptEkf::map() const {
  const std::span<const double> mean = filter_->mean();
  std::vector<seif::LandmarkEstimate> map;
  for (std::size_t row = 3; const seif::LandmarkId id : ids_) {
    map.push_back({id, {mean[row], mean[row + 1]}});
    row += 2;
  }
  return map;
}

Eigen::MatrixXd MrptEkf::covariance(const std::vector<int>& rows) const {
  const auto size = static_cast<Eigen::Index>(rows.size());
  return Eigen::MatrixXd::NullaryExpr(size, size, [&](Eigen::Index i, Eigen::Index j) {
    return filter_->covariance(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
  });
}

std::optional<seif::MarginalCovariances> MrptEkf::marginal_covariances(
    std::span<const seif::LandmarkId> landmarks) const {
  seif::MarginalCovariances marginals{.pose = *pose_covariance(), .landmarks = {}};
  for (const seif::LandmarkId landmark : landmarks)
    marginals.landmarks.emplace_back(covariance({row_of(landmark), row_of(landmark) + 1}));
  return marginals;
}

std::optional<std::vector<Eigen::MatrixXd>> MrptEkf::joint_covariances(
    std::span<const seif::LandmarkIds> groups) const {
  std::vector<Eigen::MatrixXd> joint;
  for (const seif::LandmarkIds& group : groups) {
    joint.push_back(covariance(seif::joint_rows(group, [&](seif::LandmarkId id) { return row_of(id); })));
    move_pose(joint.back(), last_pose(), since_);
  }
  return joint;
}

namespace {

std::unique_ptr<seif::Estimator> make(const seif::EstimatorSetup& setup, const seif::Options& options) {
  const seif::Pose2& sensor = setup.T_robot_sensor;
  return std::make_unique<MrptEkf>(
      make_mrpt_filter({.start = gaussian_of(setup.start.mean, setup.start.covariance),
                        .sensor_on_robot = {sensor.x, sensor.y, sensor.theta},
                        .one_scalar_at_once = seif::option<std::string>(options, "method") == "davison"}));
}

void add(seif::Registry& registry) { registry.add(mrpt_ekf_type(make)); }

}  // namespace

}  // namespace peers

SEIF_PLUGIN(peers::add)
