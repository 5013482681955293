#include "harness/stress/live_measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "harness/progress.hpp"
#include "harness/recorder.hpp"
#include "harness/simulated_stream.hpp"
#include "harness/stress/resident_memory.hpp"
#include "harness/stress/timed_simulator.hpp"

namespace harness {

namespace {

using Clock = std::chrono::steady_clock;

double us_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

/// Room for so many samples that is in memory already: taking them must not look like growth.
std::vector<double> room_for(std::size_t samples) {
  std::vector<double> room(samples, 0.0);
  room.clear();
  return room;
}

/// A stream whose scans are timed: no physics step lies between an odometry reading and the scan after it,
/// because the scans' rate divides the odometry's.
class TimedScans final : public Stream {
 public:
  TimedScans(Stream& stream, std::size_t scans) : stream_(stream), scan_us_(room_for(scans)) {}

  bool next(Event& event) override {
    const Clock::time_point begin = Clock::now();
    const bool is_there = stream_.next(event);
    if (is_there && std::holds_alternative<ScanEvent>(event)) scan_us_.push_back(us_since(begin));
    return is_there;
  }

  const std::vector<double>& scan_us() const { return scan_us_; }

 private:
  Stream& stream_;
  std::vector<double> scan_us_;
};

/// What each update cost, and how right the estimator is in the end.
class UpdateMeter final : public RunListener {
 public:
  explicit UpdateMeter(std::size_t updates) : us(room_for(updates)), blocks(room_for(updates)) {}

  void odometry(const OdometryEvent&) override {}
  void scan(const ScanEvent&) override {}
  void update(std::size_t, const UpdateRecord& record) override {
    us.push_back(record.times.update);
    blocks.push_back(static_cast<double>(record.blocks_touched));
  }
  void consistency(std::size_t, const ConsistencyRecord& record) override { last = record; }

  std::vector<double> us;
  std::vector<double> blocks;
  ConsistencyRecord last;
};

/// Everything between two scans, and what grows meanwhile.
class Cycles {
 public:
  explicit Cycles(std::int64_t updates)
      : updates_(updates), us_(room_for(static_cast<std::size_t>(updates))) {}

  /// After each scan.
  void end() {
    us_.push_back(us_since(begin_));
    if (std::ssize(us_) == updates_ / 5) settled_bytes_ = resident_bytes();
    begin_ = Clock::now();
  }

  std::vector<double>& us() { return us_; }
  /// Since the first fifth. [byte]
  double growth() const { return settled_bytes_ > 0.0 ? resident_bytes() - settled_bytes_ : 0.0; }

 private:
  std::int64_t updates_;
  std::vector<double> us_;
  double settled_bytes_ = 0.0;
  Clock::time_point begin_ = Clock::now();
};

/// What of each cycle is neither physics nor scan nor estimator.
std::vector<double> rest_of(const std::vector<double>& cycles, const std::vector<double>& steps,
                            const std::vector<double>& scans, const std::vector<double>& updates) {
  std::vector<double> rest = cycles;
  const std::size_t steps_each = cycles.empty() ? 0 : steps.size() / cycles.size();
  for (std::size_t k = 0; k < rest.size(); ++k) {
    const auto first = steps.begin() + static_cast<std::ptrdiff_t>(k * steps_each);
    rest[k] -= std::accumulate(first, first + static_cast<std::ptrdiff_t>(steps_each), scans[k]);
    if (k < updates.size()) rest[k] -= updates[k];
  }
  return rest;
}

worlds::World live_world(const StressPlan& plan, worlds::World world, const seif::Pose2& T_world_robot) {
  world.robot.start = {{T_world_robot.x, T_world_robot.y}, T_world_robot.theta};
  world.duration = static_cast<double>(plan.updates) / world.landmark_sensor.rate;
  world.seed += 1;  // noise of its own, not once more the warm start's
  if (plan.world.pattern == StressPattern::forest) world.drive.mode = worlds::DriveMode::explore;
  return world;
}

std::optional<double> aligned_rmse(const seif::Estimator& filter, const worlds::World& world) {
  std::vector<PointPair> pairs;
  for (const seif::LandmarkEstimate& landmark : filter.map()) {
    pairs.push_back(
        {landmark.mean, world.landmarks.at(static_cast<std::size_t>(landmark.landmark)).position});
  }
  return score_points(pairs).rmse_aligned;
}

StressEstimator described(const LiveEstimator& estimator, UpdateMeter& meter, const worlds::World& world) {
  StressEstimator result;
  result.name = estimator.name;
  result.skipped = estimator.failure;
  result.update_us = percentiles(meter.us);
  result.blocks = percentiles(meter.blocks);
  if (!estimator.failure.empty()) return result;
  result.landmarks = static_cast<std::int64_t>(estimator.filter->map().size());
  result.bytes = static_cast<double>(estimator.filter->memory_bytes());
  result.map_rmse = aligned_rmse(*estimator.filter, world);
  result.nees_pose = meter.last.nees_pose;
  result.nees_landmark = meter.last.nees_landmark;
  return result;
}

std::optional<Percentiles> scaled(std::optional<Percentiles> values, double factor) {
  if (values)
    *values = {values->p50 * factor, values->p95 * factor, values->p99 * factor, values->max * factor};
  return values;
}

std::vector<std::string> names_of(const Believers& believers) {
  std::vector<std::string> names;
  for (const LiveEstimator& estimator : believers.estimators) names.push_back(estimator.name);
  return names;
}

/// One live run, of one estimator or none. Fills in what the row says of everything but the estimators.
std::optional<StressEstimator> run_live(const StressPlan& plan, const worlds::World& world,
                                        Believers& believers, const std::atomic<bool>& stop, StressRow& row) {
  const auto updates = static_cast<std::size_t>(plan.updates);
  const Clock::time_point build_begin = Clock::now();
  const auto steps = static_cast<std::size_t>(world.duration * world.physics.step_rate) + 1;
  auto owned = std::make_unique<TimedSimulator>(sim::make_simulator(world), room_for(steps));
  const TimedSimulator& simulator = *owned;
  SimulatedStream simulated(world, {}, std::move(owned));
  row.build_s = 1e-6 * us_since(build_begin);

  TimedScans stream(simulated, updates);
  Recorder recorder(plan.folder, simulated.description(), names_of(believers));
  UpdateMeter meter(updates);
  const worlds::Scoring at_the_end{.interval = 1e9, .landmark_sample = world.scoring.landmark_sample};
  LiveLoop loop(stream, believers, {&recorder, &meter}, simulated.description(), at_the_end);
  Progress progress(plan.quiet, 0.0, world.duration);
  Cycles cycles(plan.updates);
  const Clock::time_point begin = Clock::now();
  loop.run(stop, [&](const LoopCounts& counts) {
    progress.show(counts.t);
    plan.after_each_update();
    cycles.end();
  });
  row.realtime_factor = loop.counts().t / (1e-6 * us_since(begin));
  row.growth_bytes_by_hour = cycles.growth() * 3600 / (0.8 * world.duration);
  row.updates = loop.counts().updates;
  row.counts = simulator.counts();
  row.process_bytes = resident_bytes();
  if (row.landmarks <= plan.most_scored) loop.score_consistency();
  recorder.close();

  std::vector<double> step_us = simulator.step_us();
  std::vector<double> scan_us = stream.scan_us();
  std::vector<double> rest_us = rest_of(cycles.us(), step_us, scan_us, meter.us);
  row.step_us = percentiles(step_us);
  row.scan_us = percentiles(scan_us);
  row.rest_us = percentiles(rest_us);
  row.second_us = scaled(percentiles(cycles.us()), world.landmark_sensor.rate);
  if (believers.estimators.empty()) return std::nullopt;
  return described(believers.estimators.front(), meter, world);
}

}  // namespace

void measure_live(const StressPlan& plan, const worlds::World& mapped, WarmStart& warm,
                  const std::atomic<bool>& stop, StressRow& row) {
  const worlds::World world = live_world(plan, mapped, warm.T_world_robot);
  std::vector<LiveEstimator>& estimators = warm.believers->estimators;
  std::vector<StressEstimator> measured;
  // The last one is the row's own: it is the first of the list.
  for (std::size_t left = std::max<std::size_t>(estimators.size(), 1); left-- > 0;) {
    Believers alone;
    StressPlan its_plan = plan;
    if (left < estimators.size()) {
      alone.estimators.push_back(std::move(estimators[left]));
      estimators.pop_back();
      its_plan.folder /= alone.estimators.front().name;
    } else {
      its_plan.folder /= "none";
    }
    std::filesystem::create_directories(its_plan.folder);
    std::optional<StressEstimator> estimator = run_live(its_plan, world, alone, stop, row);
    if (estimator) measured.push_back(std::move(*estimator));
  }
  row.estimators.insert(row.estimators.begin(), measured.rbegin(), measured.rend());
}

}  // namespace harness
