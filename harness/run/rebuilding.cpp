#include "harness/run/rebuilding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "harness/files/bad_input.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/run/replay_settings.hpp"
#include "harness/statistics/chi_square.hpp"
#include "seif/models.hpp"

namespace harness {

namespace {

std::optional<double> mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The innovations of the k observations of a scan whose landmarks are in the map.
struct Innovations {
  Eigen::VectorXd nu;  // (2k x 1)
  Eigen::MatrixXd S;   // (2k x 2k) H P H' + Q
};

/// Empty if no observed landmark is in the map, or if the filter does not give the joint covariance P of pose
/// and landmarks.
std::optional<Innovations> innovations_of(const LiveEstimator& estimator, const seif::Scan& scan,
                                          const seif::Pose2& T_robot_sensor) {
  seif::LandmarkIds seen;
  for (const seif::Observation& observation : scan.observations) seen.push_back(observation.landmark);
  std::vector<seif::LandmarkEstimate> known;
  estimator.filter->landmarks(seen, known);
  seen.clear();
  for (const seif::LandmarkEstimate& landmark : known) seen.push_back(landmark.landmark);
  if (known.empty()) return std::nullopt;
  const auto P = estimator.filter->joint_covariances({&seen, 1});
  if (!P) return std::nullopt;
  const auto size = 2 * static_cast<Eigen::Index>(known.size());
  Innovations innovations{Eigen::VectorXd(size), Eigen::MatrixXd::Zero(size, size)};
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, 3 + size);
  const double factor = estimator.observation_sd_factor * estimator.observation_sd_factor;
  std::size_t i = 0;  // index among the known landmarks, which are in the order of the observations
  for (const seif::Observation& observation : scan.observations) {
    if (i == known.size() || known[i].landmark != observation.landmark) continue;
    const seif::PredictedObservation predicted =
        predict_observation(estimator.filter->pose(), T_robot_sensor, known[i].mean);
    const auto row = 2 * static_cast<Eigen::Index>(i++);
    innovations.nu.segment<2>(row) = innovation(observation, predicted.z);
    innovations.S.block<2, 2>(row, row) = factor * observation.covariance;
    H.block<2, 3>(row, 0) = predicted.J_wrt_pose;
    H.block<2, 2>(row, 3 + row) = predicted.J_wrt_landmark;
  }
  innovations.S += H * P->front() * H.transpose();
  return innovations;
}

}  // namespace

RebuiltConsistency::RebuiltConsistency(const Believers& believers, const LogDescription& log, int sample)
    : believers_(believers),
      log_(log),
      sample_(static_cast<std::size_t>(sample)),
      true_names_(believers.estimators.size()),
      gathered_(believers.estimators.size()) {}

void RebuiltConsistency::note_truth(const std::optional<TruePose>& truth) {
  true_pose_.reset();
  if (truth) true_pose_ = truth->T_world_robot;
}

void RebuiltConsistency::scan(const ScanEvent& event) {
  note_truth(event.truth);
  latest_ = event;
  if (!std::exchange(scan_is_due_, false)) return;
  for (std::size_t i = 0; i < gathered_.size(); ++i) {
    const LiveEstimator& estimator = believers_.estimators[i];
    if (estimator.failure.empty() && estimator.filter->needs_names())
      add_innovations(estimator, event.scan, gathered_[i]);
  }
}

void RebuiltConsistency::update(std::size_t estimator, const UpdateRecord& record) {
  if (record.associations) true_names_.at(estimator).add(*record.associations, latest_);
}

void RebuiltConsistency::add_innovations(const LiveEstimator& estimator, const seif::Scan& scan,
                                         Gathered& gathered) const {
  const std::optional<Innovations> innovations = innovations_of(estimator, scan, log_.T_robot_sensor);
  if (!innovations) return;
  const auto& [nu, S] = *innovations;
  for (Eigen::Index row = 0; row < nu.size(); row += 2) {
    const auto value = nees(Eigen::Vector2d(nu.segment<2>(row)), Eigen::Matrix2d(S.block<2, 2>(row, row)));
    if (value) gathered.nis.push_back(*value);
  }
  if (const auto value = nees(nu, S)) gathered.scans.push_back({*value, static_cast<int>(nu.size())});
}

std::vector<std::pair<seif::LandmarkId, PointPair>> RebuiltConsistency::sample_of(std::size_t index) const {
  const seif::Estimator& filter = *believers_.estimators[index].filter;
  std::vector<std::pair<seif::LandmarkId, PointPair>> known;
  for (const seif::LandmarkEstimate& landmark : filter.map()) {
    const seif::LandmarkId id = true_id_of(filter, true_names_[index], landmark.landmark);
    const auto truth = std::ranges::lower_bound(*log_.landmarks, id, {}, &TrueLandmark::landmark);
    if (truth != log_.landmarks->end() && truth->landmark == id)
      known.push_back({landmark.landmark, {landmark.mean, truth->position}});
  }
  std::vector<std::pair<seif::LandmarkId, PointPair>> sample;
  for (const std::size_t i : spread_sample(known.size(), sample_)) sample.push_back(known[i]);
  return sample;
}

void RebuiltConsistency::consistency(std::size_t index, const ConsistencyRecord& record) {
  Gathered& gathered = gathered_.at(index);
  gathered.last.clear();
  if (!true_pose_ || !log_.landmarks) return;
  const LiveEstimator& estimator = believers_.estimators[index];
  const auto sample = sample_of(index);
  std::vector<seif::LandmarkIds> each;
  for (const auto& [id, pair] : sample) each.push_back({id});
  const auto joint = estimator.filter->joint_covariances(each);
  if (!joint) return;
  const PosePair pose{record.t, estimator.filter->pose(), *true_pose_};
  for (std::size_t i = 0; i < sample.size(); ++i) {
    if (const auto value = nees_from_robot(pose, sample[i].second, (*joint)[i]))
      gathered.last.push_back(*value);
  }
  if (const auto value = mean(gathered.last)) gathered.means.push_back(*value);
}

std::vector<RebuiltScore> RebuiltConsistency::scores() const {
  const ConfidenceInterval band = chi_square_band(2);
  std::vector<RebuiltScore> scores;
  for (const Gathered& gathered : gathered_) {
    scores.push_back({.nis = mean(gathered.nis),
                      .observations = gathered.nis.size(),
                      .nis_inside = share_inside(gathered.nis, band),
                      .scans = score_scans(gathered.scans),
                      .nees_landmark_from_robot = mean(gathered.means),
                      .nees_landmark_from_robot_final = mean(gathered.last),
                      .landmarks_from_robot_inside = share_inside(gathered.last, band)});
  }
  return scores;
}

std::vector<RebuiltScore> rebuild(const Rebuilding& rebuilding, const Summary& summary,
                                  const seif::Registry& registry,
                                  const std::function<void(const Believers&)>& look) {
  const worlds::LoadResult settings = load_replay_settings(
      rebuilding.run, {rebuilding.estimators, rebuilding.overrides, fmt::format("{}", summary.seed)},
      registry);
  if (!settings.world) throw BadInput(worlds::to_string(settings.problems.front()));
  PreparedRun run = prepare_replay(rebuilding.run, *settings.world, registry);
  run.plan.folder = rebuilding.to;
  if (rebuilding.interval) run.plan.scoring.interval = *rebuilding.interval;
  RebuiltConsistency rebuilt(*run.believers, *run.log, run.plan.scoring.landmark_sample);
  const RunResult result = execute(run, &rebuilt);
  if (result.bad_input) throw BadInput(result.error);
  if (result.summary.interrupted) throw std::runtime_error("interrupted");
  if (!rebuilding.is_other && result.summary.trajectory_hash != summary.trajectory_hash)
    throw NotReplayed(fmt::format("{}: does not replay to the same estimates; it was made by version {}",
                                  rebuilding.run.string(), summary.version));
  if (look) look(*run.believers);
  return rebuilt.scores();
}

}  // namespace harness
