#include "harness/live/live_run.hpp"

#include <filesystem>
#include <utility>
#include <variant>

namespace harness {

namespace {

PreparedRun prepared(const LiveSource& source, const worlds::World& world) {
  PreparedRun run =
      source.log ? prepare_replay(*source.log, world, source.registry) : prepare_run(world, source.registry);
  run.believers->dead_reckoning = run.log->start.mean;
  return run;
}

std::vector<std::string> names_in(const Believers& believers) {
  std::vector<std::string> names;
  for (const LiveEstimator& estimator : believers.estimators) names.push_back(estimator.name);
  return names;
}

}  // namespace

LiveRun::LiveRun(const LiveSource& source, const worlds::World& world, LiveChannels& channels,
                 std::uint64_t epoch)
    : run_(prepared(source, world)), simulation_(dynamic_cast<SimulatedStream*>(run_.stream.get())) {
  recorder_.emplace(folder_.path(), *run_.log, names_in(*run_.believers));
  observer_.emplace(world, source.knows_world,
                    LiveObserver::Ends{*run_.believers, *run_.log, channels.snapshots, channels.wish}, epoch);
  loop_.emplace(*run_.stream, *run_.believers, std::vector<RunListener*>{&*recorder_, &*observer_}, *run_.log,
                run_.plan.scoring);
  for (const OptionChange& change : run_.plan.option_changes) loop_->change(change);
}

LiveRun::Advance LiveRun::advance() {
  Advance done = Advance::event;
  if (simulation_ != nullptr) {
    done = simulation_->advance(event_);
  } else if (!run_.stream->next(event_)) {
    done = Advance::end;
  }
  if (done != Advance::event) return done;
  if (const auto* scan = std::get_if<ScanEvent>(&event_)) {
    latest_scan_ = scan->scan;
    sightings_.add(*scan);
  }
  loop_->take(event_);
  return done;
}

void LiveRun::settle() {
  while (simulation_ != nullptr && simulation_->is_due()) advance();
}

double LiveRun::t() const {
  return simulation_ != nullptr ? simulation_->next_step_t() - simulation_->step_s() : loop_->counts().t;
}

std::int64_t LiveRun::steps() const {
  return simulation_ != nullptr ? simulation_->physics_steps() : loop_->counts().events;
}

void LiveRun::publish(const LiveStatus& status) {
  std::optional<TruePose> truth;
  if (simulation_ != nullptr) {
    const sim::RobotState robot = simulation_->robot();
    truth = TruePose{robot.t,
                     {robot.position.x(), robot.position.y(), robot.heading},
                     robot.left_wheel,
                     robot.right_wheel};
  }
  observer_->publish_if_due(status, truth, steps());
}

std::string LiveRun::hash_so_far() {
  settle();
  for (const LiveEstimator& estimator : run_.believers->estimators)
    std::filesystem::remove(folder_ / (estimator.name + "_map.csv"));  // of an earlier call
  loop_->finish();
  recorder_->scored();  // writes out what is buffered
  return trajectory_hash(folder_.path());
}

}  // namespace harness
