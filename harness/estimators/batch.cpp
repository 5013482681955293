#include "harness/estimators/batch.hpp"

#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "seif/marginals.hpp"
#include "seif/models.hpp"

namespace harness {

namespace {

const seif::StageDone ignore = [](seif::Stage) {};

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

}  // namespace

Batch::Batch(const seif::EstimatorSetup& setup, std::unique_ptr<seif::Estimator> guide, double robust_above)
    : guide_(std::move(guide)), T_robot_sensor_(setup.T_robot_sensor) {
  slam_.start = setup.start;
  slam_.robust_above = robust_above;
}

void Batch::motion_update(const seif::Odometry& odometry) {
  solved_.reset();
  guide_->motion_update(odometry);
  since_last_pose_ = compose(since_last_pose_, odometry);
}

void Batch::measurement_update(const seif::Scan& scan, const seif::StageDone& done) {
  solved_.reset();
  guide_->measurement_update(scan, ignore);
  if (!is_certain(since_last_pose_)) slam_.motions.push_back(std::exchange(since_last_pose_, {}));
  const seif::Pose2 T_pose_sensor = since_last_pose_.T_previous_current * T_robot_sensor_;
  scan_poses_.push_back({slam_.pose_count() - 1, since_last_pose_.T_previous_current});
  for (const seif::Observation& observation : scan.observations) {
    slam_.sightings.push_back(
        {slam_.pose_count() - 1, landmark_number(observation.landmark), T_pose_sensor, observation});
  }
  active_landmarks_ = static_cast<int>(scan.observations.size());
  done(seif::Stage::measurement);
}

/// The number of a landmark. A new landmark gets the next number.
int Batch::landmark_number(seif::LandmarkId landmark) {
  if (const auto number = index_.find(landmark)) return *number;
  ids_.push_back(landmark);
  index_.insert(landmark, slam_.landmark_count);
  return slam_.landmark_count++;
}

const FullSlamOptimum& Batch::solved() const {
  if (solved_) return *solved_;
  std::vector<Eigen::Vector2d> landmarks(ids_.size());
  for (const seif::LandmarkEstimate& estimate : guide_->map())
    landmarks.at(static_cast<std::size_t>(index_.find(estimate.landmark).value())) = estimate.mean;
  return solved_.emplace(optimum(slam_, poses_on_map(slam_, landmarks), landmarks));
}

seif::Pose2 Batch::pose() const {
  return solved_ ? solved_->poses.back() * since_last_pose_.T_previous_current : guide_->pose();
}

seif::Counts Batch::counts() const {
  return {.blocks_touched = guide_->counts().blocks_touched,
          .active_landmarks = active_landmarks_,
          .links = static_cast<std::int64_t>(slam_.sightings.size())};
}

std::size_t Batch::memory_bytes() const {
  return guide_->memory_bytes() + bytes_of(slam_.motions) + bytes_of(slam_.sightings) +
         bytes_of(scan_poses_) + bytes_of(ids_) + index_.memory_bytes();
}

void Batch::landmarks(std::span<const seif::LandmarkId> landmarks,
                      std::vector<seif::LandmarkEstimate>& out) const {
  if (solved_) {
    Estimator::landmarks(landmarks, out);
  } else {
    guide_->landmarks(landmarks, out);
  }
}

std::vector<seif::LandmarkEstimate> Batch::map() const {
  std::vector<seif::LandmarkEstimate> map;
  map.reserve(ids_.size());
  for (std::size_t i = 0; i < ids_.size(); ++i) map.push_back({ids_[i], solved().landmarks[i]});
  return map;
}

std::optional<seif::MarginalCovariances> Batch::marginal_covariances(
    std::span<const seif::LandmarkId> landmarks) const {
  const FullSlamOptimum& now = solved();
  std::vector<int> rows;
  for (const seif::LandmarkId landmark : landmarks)
    rows.push_back(slam_.row_of_landmark(index_.find(landmark).value()));
  auto marginals = seif::marginals_of(now.Omega, slam_.row_of_pose(slam_.pose_count() - 1), rows);
  if (!marginals) return std::nullopt;
  Eigen::MatrixXd pose = marginals->pose;
  move_pose(pose, now.poses.back(), since_last_pose_);
  marginals->pose = pose;
  return marginals;
}

std::optional<std::vector<Eigen::MatrixXd>> Batch::joint_covariances(
    std::span<const seif::LandmarkIds> groups) const {
  if (!solved_) return std::nullopt;
  std::vector<std::vector<int>> blocks;
  for (const seif::LandmarkIds& group : groups) {
    std::vector<int>& rows = blocks.emplace_back(seif::joint_rows(
        group, [&](seif::LandmarkId id) { return slam_.row_of_landmark(index_.find(id).value()); }));
    std::iota(rows.begin(), rows.begin() + 3, slam_.row_of_pose(slam_.pose_count() - 1));
  }
  auto joint = seif::blocks_of_inverse(solved_->Omega, blocks);
  if (!joint) return std::nullopt;
  for (Eigen::MatrixXd& Sigma : *joint) move_pose(Sigma, solved_->poses.back(), since_last_pose_);
  return joint;
}

std::vector<seif::Pose2> Batch::trajectory() const {
  std::vector<seif::Pose2> poses;
  for (const ScanPose& scan : scan_poses_)
    poses.push_back(solved().poses[static_cast<std::size_t>(scan.pose)] * scan.T_pose_robot);
  return poses;
}

seif::EstimatorType batch_estimator(const seif::Registry& registry) {
  const seif::OptionSpec guide{
      .key = "guide",
      .fallback = std::string("seif"),
      .choices = {"seif", "ekf"},
      .help = "The filter that runs along, and from whose map the optimum is sought."};
  const seif::OptionSpec robust_above{.key = "robust_above",
                                      .fallback = 0.0,
                                      .min = 0.0,
                                      .help =
                                          "Observations that are further off than this weigh less, by "
                                          "Cauchy's function, and the guide's gate "
                                          "is the square of it; 0: none does [sigma]."};
  return {.name = "batch",
          .help =
              "The least-squares optimum of all poses and landmarks, solved for at scoring times: neither in "
              "constant time nor memory; what the others are measured against.",
          .options = {guide, robust_above},
          .make = [guide, robust_above, registry](const seif::EstimatorSetup& setup,
                                                  const seif::Options& options) {
            const auto* type = registry.find(seif::option<std::string>(options, guide.key));
            if (type == nullptr) throw std::invalid_argument("batch: its guide is not registered");
            seif::Options defaults;
            for (const seif::OptionSpec& spec : type->options) defaults[spec.key] = spec.fallback;
            const double above = seif::option<double>(options, robust_above.key);
            defaults["gate"] = above * above;
            return std::make_unique<Batch>(setup, type->make(setup, defaults), above);
          }};
}

}  // namespace harness
