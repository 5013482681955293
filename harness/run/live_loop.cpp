#include "harness/run/live_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

#include "harness/estimators/plugins.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/score/score.hpp"
#include "sensors/random_stream.hpp"

namespace harness {

namespace {

constexpr double rounding = 1e-9;  // [-] relative to a scoring interval

bool is_finite(const seif::Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta);
}

double microseconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double, std::micro>(duration).count();
}

double time_of(const OdometryEvent& event) { return event.odometry.t; }
double time_of(const ScanEvent& event) { return event.scan.t; }

void add(std::optional<double>& sum, double value) { sum = sum.value_or(0.0) + value; }

std::optional<double>& stage(UpdateTimes& times, seif::Stage which) {
  return times.stages[static_cast<std::size_t>(which)];
}

void check_name(const std::string& name, std::span<const LiveEstimator> others) {
  if (name == "truth" || name == "odometry" || file_name_of(name) != name)
    throw BadInput(fmt::format("'{}' cannot be the name of an estimator: its files bear that name", name));
  if (std::ranges::find(others, name, &LiveEstimator::name) != others.end())
    throw BadInput(fmt::format("two estimators have the name '{}'", name));
}

/// Runs a step of an estimator. If the step throws, the estimator is removed and the others continue.
template <class Step>
void guard(LiveEstimator& estimator, double t, const Step& step) {
  try {
    step();
  } catch (const std::exception& error) {
    estimator.failure = fmt::format("at {} s: {}", t, error.what());
  } catch (...) {  // a plug-in may throw anything
    estimator.failure = fmt::format("at {} s: it threw something that is no std::exception", t);
  }
}

}  // namespace

seif::LandmarkId true_id_of(const seif::Estimator& filter, const TrueNames& names,
                            seif::LandmarkId landmark) {
  return filter.needs_names() ? landmark : names.of(landmark);
}

std::vector<LiveEstimator> make_estimators(const seif::Registry& registry,
                                           std::span<const worlds::EstimatorChoice> choices,
                                           const LogDescription& log, std::uint64_t seed) {
  std::vector<LiveEstimator> estimators;
  for (const worlds::EstimatorChoice& choice : choices) {
    check_name(choice.name, estimators);
    const seif::EstimatorSetup setup{log.start, log.T_robot_sensor,
                                     sensors::random_stream(seed, "estimator/" + choice.name)};
    std::unique_ptr<seif::Estimator> filter = type_of(registry, choice).make(setup, choice.options);
    if (!log.known_association && filter->needs_names())
      throw BadInput(fmt::format(
          "{}: the observations of {} do not say which landmark they are of, and this estimator needs that",
          choice.name, log.name));
    estimators.push_back(
        {choice.name, std::move(filter), choice.odometry_sd_factor, choice.observation_sd_factor, {}});
  }
  return estimators;
}

std::function<seif::Pose2()> steering_pose(const std::string& pose_from, const Believers& believers) {
  if (pose_from == "truth") return {};
  if (pose_from == "odometry") return [&believers] { return believers.dead_reckoning; };
  return [pose_from, &believers] {
    const auto it = std::ranges::find(believers.estimators, pose_from, &LiveEstimator::name);
    if (it == believers.estimators.end())
      throw std::runtime_error(fmt::format("there is no estimator '{}' to steer by", pose_from));
    if (!it->failure.empty())
      throw std::runtime_error(fmt::format("{} steers and has failed {}", pose_from, it->failure));
    const seif::Pose2 pose = it->filter->pose();
    if (!is_finite(pose))
      throw std::runtime_error(fmt::format("{} steers and its pose is not finite", pose_from));
    return pose;
  };
}

LiveLoop::LiveLoop(Stream& stream, Believers& believers, std::vector<RunListener*> listeners,
                   const LogDescription& log, const worlds::Scoring& scoring)
    : stream_(stream),
      believers_(believers),
      listeners_(std::move(listeners)),
      log_(log),
      scoring_(scoring),
      screening_(log),
      times_(believers.estimators.size()),
      true_names_(believers.estimators.size()) {
  counts_.t = log.start_t;
  for (const LiveEstimator& estimator : believers.estimators)
    blocks_touched_.push_back(estimator.filter->counts().blocks_touched);
  stage_done_ = [this](seif::Stage done) { end_stage(done); };
}

void LiveLoop::end_stage(seif::Stage done) {
  Clock::time_point now = Clock::now();
  add(stage(times_[running_.estimator], done), microseconds(now - running_.stage_begin));
  if (watch_) {
    watch_(running_.estimator, done);
    const Clock::time_point seen = Clock::now();
    running_.watched += seen - now;
    now = seen;
  }
  running_.stage_begin = now;
}

void LiveLoop::run(const std::atomic<bool>& stop, const std::function<void(const LoopCounts&)>& progress) {
  Event event;
  while (!stop) {
    if (!stream_.next(event)) return;
    if (!take(event)) continue;
    if (progress && std::holds_alternative<ScanEvent>(event)) progress(counts_);
  }
  counts_.interrupted = true;
}

bool LiveLoop::take(Event& event) {
  if (!screening_.admit(event)) return false;
  ++counts_.events;
  std::visit(
      [this](const auto& admitted) {
        changes_.apply_before(time_of(admitted), believers_.estimators);
        take(admitted);
      },
      event);
  return true;
}

void LiveLoop::take(const OdometryEvent& event) {
  counts_.t = event.odometry.t;
  note_truth(event.truth);
  for (RunListener* listener : listeners_) listener->odometry(event);
  believers_.dead_reckoning = believers_.dead_reckoning * event.odometry.T_previous_current;
  for (std::size_t i = 0; i < believers_.estimators.size(); ++i) motion_update(i, event.odometry);
}

void LiveLoop::motion_update(std::size_t index, const seif::Odometry& odometry) {
  LiveEstimator& estimator = believers_.estimators[index];
  if (!estimator.failure.empty()) return;
  seif::Odometry believed = odometry;
  if (estimator.odometry_sd_factor != 1.0)
    believed.covariance *= estimator.odometry_sd_factor * estimator.odometry_sd_factor;
  guard(estimator, odometry.t, [&] {
    const Clock::time_point begin = Clock::now();
    estimator.filter->motion_update(believed);
    const double duration = microseconds(Clock::now() - begin);
    times_[index].update += duration;
    add(stage(times_[index], seif::Stage::motion), duration);
  });
}

void LiveLoop::take(const ScanEvent& event) {
  counts_.t = event.scan.t;
  ++counts_.updates;
  for (RunListener* listener : listeners_) listener->scan(event);
  for (RunListener* listener : listeners_) listener->dead_reckoning(event.scan.t, believers_.dead_reckoning);
  note_truth(event.truth);
  for (std::size_t i = 0; i < believers_.estimators.size(); ++i) measurement_update(i, event);
  const double intervals = (counts_.t - log_.start_t) / scoring_.interval + rounding;
  if (intervals < static_cast<double>(intervals_scored_ + 1)) return;
  intervals_scored_ = static_cast<std::int64_t>(intervals);
  score_consistency();
  for (RunListener* listener : listeners_) listener->scored();
}

void LiveLoop::note_truth(const std::optional<TruePose>& truth) {
  last_true_pose_.reset();
  if (truth) last_true_pose_ = truth->T_world_robot;
  if (counts_.events == 1) frame_is_known_ = log_.true_start || truth;
}

void LiveLoop::measurement_update(std::size_t index, const ScanEvent& event) {
  LiveEstimator& estimator = believers_.estimators[index];
  if (!estimator.failure.empty()) return;
  const seif::Scan& scan = scaled(event.scan, estimator.observation_sd_factor);
  guard(estimator, event.scan.t, [&] {
    if (watch_) watch_(index, seif::Stage::motion);
    const Clock::time_point begin = Clock::now();
    running_ = {index, begin, {}};
    estimator.filter->measurement_update(scan, stage_done_);
    times_[index].update += microseconds(Clock::now() - begin - running_.watched);
    if (!is_finite(estimator.filter->pose())) throw std::runtime_error("the pose is not finite any more");
  });
  if (!estimator.failure.empty()) return;

  UpdateRecord record;
  guard(estimator, event.scan.t, [&] { record = record_of(index, event); });
  if (!estimator.failure.empty()) return;
  for (RunListener* listener : listeners_) listener->update(index, record);
}

UpdateRecord LiveLoop::record_of(std::size_t index, const ScanEvent& event) {
  const seif::Estimator& filter = *believers_.estimators[index].filter;
  UpdateRecord record;
  record.t = event.scan.t;
  record.est_pose = filter.pose();
  record.est_covariance = filter.pose_covariance();
  if (record.est_covariance && !record.est_covariance->allFinite()) record.est_covariance.reset();
  record.true_pose = last_true_pose_;
  record.counts = filter.counts();
  record.blocks_touched = record.counts.blocks_touched - blocks_touched_[index];
  blocks_touched_[index] = record.counts.blocks_touched;
  record.times = times_[index];
  if (!filter.needs_names()) {
    record.associations = filter.associations();
    true_names_[index].add(*record.associations, event);
  }
  times_[index] = {};
  return record;
}

const seif::Scan& LiveLoop::scaled(const seif::Scan& scan, double sd_factor) {
  if (sd_factor == 1.0) return scan;
  scaled_scan_ = scan;
  for (seif::Observation& observation : scaled_scan_.observations)
    observation.covariance *= sd_factor * sd_factor;
  return scaled_scan_;
}

void LiveLoop::score_consistency() {
  last_scoring_t_ = counts_.t;
  for (std::size_t i = 0; i < believers_.estimators.size(); ++i) {
    LiveEstimator& estimator = believers_.estimators[i];
    if (!estimator.failure.empty()) continue;
    std::optional<ConsistencyRecord> record;
    guard(estimator, counts_.t, [&] { record = consistency_of(i); });
    if (!record) continue;
    for (RunListener* listener : listeners_) listener->consistency(i, *record);
  }
}

const TrueLandmark* LiveLoop::true_landmark(seif::LandmarkId id) const {
  if (!log_.landmarks) return nullptr;
  const auto it = std::ranges::lower_bound(*log_.landmarks, id, {}, &TrueLandmark::landmark);
  return it != log_.landmarks->end() && it->landmark == id ? &*it : nullptr;
}

ConsistencyRecord LiveLoop::consistency_of(std::size_t index) const {
  const LiveEstimator& estimator = believers_.estimators[index];
  const std::vector<seif::LandmarkEstimate> map = estimator.filter->map();
  std::vector<seif::LandmarkId> ids;
  std::vector<Eigen::Vector2d> errors;
  for (const seif::LandmarkEstimate& landmark : map) {
    const TrueLandmark* truth =
        true_landmark(true_id_of(*estimator.filter, true_names_[index], landmark.landmark));
    if (truth == nullptr) continue;
    ids.push_back(landmark.landmark);
    errors.push_back(landmark.mean - truth->position);
  }
  std::vector<seif::LandmarkId> sampled_ids;
  std::vector<Eigen::Vector2d> sampled_errors;
  for (const std::size_t i : spread_sample(ids.size(), static_cast<std::size_t>(scoring_.landmark_sample))) {
    sampled_ids.push_back(ids[i]);
    sampled_errors.push_back(errors[i]);
  }

  ConsistencyRecord record;
  record.t = counts_.t;
  record.landmarks_mapped = static_cast<int>(map.size());
  record.memory_bytes = static_cast<std::int64_t>(estimator.filter->memory_bytes());
  if (!frame_is_known_) return record;
  const std::optional<seif::MarginalCovariances> belief = estimator.filter->marginal_covariances(sampled_ids);
  if (!belief) return record;
  if (last_true_pose_)
    record.nees_pose = nees(pose_error(estimator.filter->pose(), *last_true_pose_), belief->pose);
  double sum = 0.0;
  for (std::size_t i = 0; i < sampled_errors.size(); ++i) {
    const std::optional<double> value = nees(sampled_errors[i], belief->landmarks.at(i));
    if (!value) continue;
    sum += *value;
    ++record.landmarks_scored;
  }
  if (record.landmarks_scored > 0) record.nees_landmark = sum / record.landmarks_scored;
  return record;
}

void LiveLoop::finish() {
  if (counts_.updates > 0 && last_scoring_t_ != counts_.t) score_consistency();
  for (std::size_t i = 0; i < believers_.estimators.size(); ++i) tell_map(i);
}

void LiveLoop::tell_map(std::size_t index) {
  LiveEstimator& estimator = believers_.estimators[index];
  std::vector<MapRecord> records;
  guard(estimator, counts_.t, [&] {
    std::vector<seif::LandmarkId> ids;
    std::size_t not_finite = 0;
    for (const seif::LandmarkEstimate& landmark : estimator.filter->map()) {
      if (!landmark.mean.allFinite()) {
        ++not_finite;
        continue;
      }
      records.push_back({landmark.landmark, landmark.mean, {}});
      ids.push_back(landmark.landmark);
    }
    if (not_finite > 0 && estimator.failure.empty())
      estimator.failure =
          fmt::format("at {} s: {} landmarks of its map are not finite", counts_.t, not_finite);
    const std::optional<seif::MarginalCovariances> belief = estimator.filter->marginal_covariances(ids);
    for (std::size_t k = 0; belief && k < records.size(); ++k) {
      if (belief->landmarks.at(k).allFinite()) records[k].covariance = belief->landmarks[k];
    }
  });
  for (RunListener* listener : listeners_) listener->map(index, records);
}

}  // namespace harness
