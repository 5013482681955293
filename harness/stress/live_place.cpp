#include "harness/stress/live_place.hpp"

#include <chrono>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <variant>

#include "harness/recording/recorder.hpp"
#include "harness/score/score.hpp"
#include "harness/simulation/simulated_stream.hpp"
#include "harness/stress/resident_memory.hpp"
#include "harness/stress/timed_simulator.hpp"
#include "harness/terminal/progress.hpp"

namespace harness {

namespace {

using Clock = std::chrono::steady_clock;

double us_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

std::vector<double> room_for(std::int64_t samples) {
  std::vector<double> room(static_cast<std::size_t>(samples), 0.0);
  room.clear();
  return room;
}

std::int64_t steps_in(std::int64_t updates, const worlds::World& world) {
  const double duration = static_cast<double>(updates) / world.landmark_sensor.rate;
  return static_cast<std::int64_t>(duration * world.physics.step_rate) + 1;
}

/// A stream whose scans are timed. No physics step lies between an odometry reading and the scan after it,
/// because the odometry's rate is a multiple of the scans' rate.
class TimedScans final : public Stream {
 public:
  TimedScans(Stream& stream, LiveSamples& samples) : stream_(stream), samples_(samples) {}

  bool next(Event& event) override {
    const Clock::time_point begin = Clock::now();
    const bool is_there = stream_.next(event);
    if (is_there && std::holds_alternative<ScanEvent>(event)) samples_.scan_us.push_back(us_since(begin));
    return is_there;
  }

 private:
  Stream& stream_;
  LiveSamples& samples_;
};

/// Records the cost of each update and the estimator's latest scores.
class UpdateMeter final : public RunListener {
 public:
  explicit UpdateMeter(LiveSamples& samples) : samples_(samples) {}

  void odometry(const OdometryEvent&) override {}
  void scan(const ScanEvent&) override {}
  void update(std::size_t, const UpdateRecord& record) override {
    samples_.update_us.push_back(record.times.update);
    samples_.blocks.push_back(static_cast<double>(record.blocks_touched));
    samples_.nees_pose.reset();
    if (record.est_covariance && record.true_pose)
      samples_.nees_pose = nees(pose_error(record.est_pose, *record.true_pose), *record.est_covariance);
  }
  void consistency(std::size_t, const ConsistencyRecord& record) override {
    samples_.nees_pose = record.nees_pose;
    samples_.nees_landmark = record.nees_landmark;
  }

 private:
  LiveSamples& samples_;
};

/// Measures the time between scans, and the growth of memory.
class Cycles {
 public:
  Cycles(std::int64_t updates, std::vector<double>& us) : updates_(updates), us_(us) {}

  /// Must be called after each scan.
  void end() {
    us_.push_back(us_since(begin_));
    if (std::ssize(us_) == updates_ / 5) settled_bytes_ = resident_bytes();
    begin_ = Clock::now();
  }

  /// Growth of memory since the first fifth of the updates. [byte]
  double growth() const { return settled_bytes_ > 0.0 ? resident_bytes() - settled_bytes_ : 0.0; }

 private:
  std::int64_t updates_;
  std::vector<double>& us_;
  double settled_bytes_ = 0.0;
  Clock::time_point begin_ = Clock::now();
};

/// Computes the part of each cycle that is neither physics nor scan nor estimator.
void find_rest(LiveSamples& samples) {
  samples.rest_us.assign(samples.cycle_us.begin(), samples.cycle_us.end());
  const std::size_t steps_each =
      samples.cycle_us.empty() ? 0 : samples.step_us.size() / samples.cycle_us.size();
  for (std::size_t k = 0; k < samples.rest_us.size(); ++k) {
    const auto first = samples.step_us.begin() + static_cast<std::ptrdiff_t>(k * steps_each);
    double& rest = samples.rest_us[k];
    rest -= std::accumulate(first, first + static_cast<std::ptrdiff_t>(steps_each), samples.scan_us[k]);
    if (k < samples.update_us.size()) rest -= samples.update_us[k];
  }
}

std::vector<std::string> names_of(const Believers& believers) {
  std::vector<std::string> names;
  for (const LiveEstimator& estimator : believers.estimators) names.push_back(estimator.name);
  return names;
}

}  // namespace

LiveSamples::LiveSamples(std::int64_t expected_updates, const worlds::World& world)
    : step_us(room_for(steps_in(expected_updates, world))),
      scan_us(room_for(expected_updates)),
      update_us(room_for(expected_updates)),
      rest_us(room_for(expected_updates)),
      cycle_us(room_for(expected_updates)),
      blocks(room_for(expected_updates)) {}

void LiveSamples::add(const LiveSamples& other) {
  const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(step_us, other.step_us);
  append(scan_us, other.scan_us);
  append(update_us, other.update_us);
  append(rest_us, other.rest_us);
  append(cycle_us, other.cycle_us);
  append(blocks, other.blocks);
  counts.steps += other.counts.steps;
  counts.objects_stepped += other.counts.objects_stepped;
  counts.rays += other.counts.rays;
  counts.candidates += other.counts.candidates;
  updates += other.updates;
  t += other.t;
  wall_s += other.wall_s;
  process_bytes = other.process_bytes;
  growth_bytes += other.growth_bytes;
  build_s = other.build_s;
  nees_pose = other.nees_pose;
  nees_landmark = other.nees_landmark;
  T_world_robot = other.T_world_robot;
}

LiveSamples measure_place(const LivePlace& place, Believers& believers,
                          const std::function<void()>& after_each_update, const std::atomic<bool>& stop) {
  const worlds::World& world = place.world;
  LiveSamples samples(place.updates, world);
  const Clock::time_point build_begin = Clock::now();
  auto owned = std::make_unique<TimedSimulator>(sim::make_simulator(world), samples.step_us);
  const TimedSimulator& simulator = *owned;
  SimulatedStream simulated(world, {}, std::move(owned));
  samples.build_s = 1e-6 * us_since(build_begin);

  TimedScans stream(simulated, samples);
  std::filesystem::create_directories(place.folder);
  Recorder recorder(place.folder, simulated.description(), names_of(believers));
  UpdateMeter meter(samples);
  const worlds::Scoring at_the_end{.interval = 1e9, .landmark_sample = world.scoring.landmark_sample};
  LiveLoop loop(stream, believers, {&recorder, &meter}, simulated.description(), at_the_end);
  Progress progress(place.quiet, 0.0, world.duration);
  Cycles cycles(place.updates, samples.cycle_us);
  const Clock::time_point begin = Clock::now();
  loop.run(stop, [&](const LoopCounts& counts) {
    progress.show(counts.t);
    after_each_update();
    cycles.end();
  });
  samples.wall_s = 1e-6 * us_since(begin);
  samples.process_bytes = resident_bytes();
  samples.growth_bytes = cycles.growth();
  samples.t = loop.counts().t;
  samples.updates = loop.counts().updates;
  samples.counts = simulator.counts();
  const sim::RobotState robot = simulator.robot();
  samples.T_world_robot = {robot.position.x(), robot.position.y(), robot.heading};
  if (place.has_covariances && !stop) loop.score_consistency();
  recorder.close();
  find_rest(samples);
  return samples;
}

}  // namespace harness
