#include "harness/live/live_observer.hpp"

#include <utility>

namespace harness {

namespace {

constexpr double share_for_snapshots = 0.01;  // [-] of the time of a busy run
constexpr double idle_share_for_snapshots = 0.2;
constexpr std::chrono::milliseconds watched_period{33};
constexpr std::chrono::milliseconds alone_period{250};  // while no page is open
constexpr std::size_t most_for_hidden_rays = 20'000;  // [-] landmarks of a world that is held twice for them
constexpr std::size_t most_rays = 256;                // [-]

}  // namespace

LiveObserver::LiveObserver(const worlds::World& world, bool knows_world, const Ends& ends,
                           std::uint64_t epoch)
    : ends_(ends),
      epoch_(epoch),
      stage_(world, knows_world, ends.log, {}),
      sight_(world, knows_world && world.landmarks.size() <= most_for_hidden_rays, ends.log.T_robot_sensor),
      thrift_(share_for_snapshots, idle_share_for_snapshots, watched_period),
      t_(ends.log.start_t),
      truth_(ends.log.true_start) {
  for (const LiveEstimator& estimator : ends.believers.estimators) readers_.emplace_back(estimator);
}

void LiveObserver::look_at_landmarks() {
  for (const TrueLandmark& landmark : *ends_.log.landmarks) stage_.put_landmark(landmark);
}

void LiveObserver::odometry(const OdometryEvent& event) {
  t_ = event.odometry.t;
  truth_ = event.truth;
  if (truth_) true_trail_.add(truth_->T_world_robot.x, truth_->T_world_robot.y);
}

void LiveObserver::scan(const ScanEvent& event) {
  t_ = event.scan.t;
  truth_ = event.truth;
  ++updates_;
  latest_scan_ = event;
  has_new_scan_ = true;
  for (BeliefReader& reader : readers_) reader.scan(event);
}

void LiveObserver::dead_reckoning(double /*t*/, const seif::Pose2& T_world_robot) {
  odometry_trail_.add(T_world_robot.x, T_world_robot.y);
}

void LiveObserver::update(std::size_t estimator, const UpdateRecord& record) {
  readers_[estimator].update(record);
}

void LiveObserver::consistency(std::size_t estimator, const ConsistencyRecord& record) {
  readers_[estimator].consistency(record);
}

void LiveObserver::publish_if_due(const LiveStatus& status, const std::optional<TruePose>& truth,
                                  std::int64_t steps) {
  const Clock::time_point begin = Clock::now();
  if (!thrift_.may(begin, status.is_idle)) return;
  LiveSnapshot* snapshot = ends_.exchange.to_write();
  if (snapshot == nullptr) return;
  ends_.wish.get(view_);
  snapshot->steps = steps;
  snapshot->truth = truth ? truth : truth_;
  const Clock::duration apart = fill(*snapshot, status);
  ends_.exchange.publish();
  thrift_.spent(begin, Clock::now() - begin - apart);
  if (view_.pages == 0) thrift_.pause_until(begin + alone_period);
}

/// Returns what was spent on readings that have a thrift of their own.
LiveObserver::Clock::duration LiveObserver::fill(LiveSnapshot& snapshot, const LiveStatus& status) {
  Clock::duration apart{};
  snapshot.epoch = epoch_;
  snapshot.t = snapshot.truth ? snapshot.truth->t : t_;
  snapshot.updates = updates_;
  snapshot.status = status;
  snapshot.odometry = ends_.believers.dead_reckoning;
  true_trail_.hand_over(snapshot.true_trail);
  odometry_trail_.hand_over(snapshot.odometry_trail);
  read_rays(snapshot);
  snapshot.beliefs.resize(readers_.size());
  snapshot.matrix.reset();
  const bool is_in_update = status.state == LiveState::stage;
  const BeliefReader::Depth depth = is_in_update     ? BeliefReader::Depth::pose
                                    : status.is_idle ? BeliefReader::Depth::much
                                                     : BeliefReader::Depth::little;
  for (std::size_t i = 0; i < readers_.size(); ++i) {
    apart += readers_[i].read(view_, depth, snapshot.beliefs[i]);
    if (!view_.matrix || is_in_update || readers_[i].estimator().name != status.watched) continue;
    const Clock::time_point begin = Clock::now();
    if (LiveMatrix matrix; readers_[i].read_matrix(matrix)) snapshot.matrix = std::move(matrix);
    apart += Clock::now() - begin;
  }
  return apart;
}

/// From where the robot was at the scan; the page lets them begin at the robot.
void LiveObserver::read_rays(LiveSnapshot& snapshot) {
  if (!has_new_scan_) return;
  has_new_scan_ = false;
  const seif::Pose2 pose =
      latest_scan_.truth ? latest_scan_.truth->T_world_robot : ends_.believers.dead_reckoning;
  sight_.scan(latest_scan_, pose, stage_);
  snapshot.rays.clear();
  for (const Sight::Ray& ray : sight_.rays()) {
    if (snapshot.rays.size() >= most_rays) break;
    snapshot.rays.push_back({{static_cast<float>(ray.end.x()), static_cast<float>(ray.end.y())},
                             static_cast<LiveRay::Kind>(ray.kind)});
  }
}

}  // namespace harness
