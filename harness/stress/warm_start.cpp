#include "harness/stress/warm_start.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "harness/simulation/simulated_stream.hpp"

namespace harness {

namespace {

/// The progress of a round.
class Round final : public RunListener {
 public:
  Round(const worlds::World& world, std::size_t estimators)
      : start_(world.robot.start.position), seen_(world.landmarks.size()), update_us_(estimators) {}

  void odometry(const OdometryEvent& event) override {
    const seif::Pose2& increment = event.odometry.T_previous_current;
    driven_ += std::hypot(increment.x, increment.y);
  }

  void scan(const ScanEvent& event) override {
    T_world_robot_ = event.truth->T_world_robot;
    for (const seif::Observation& z : event.scan.observations) {
      if (seen_.at(static_cast<std::size_t>(z.landmark))) continue;
      seen_[static_cast<std::size_t>(z.landmark)] = true;
      ++landmarks_;
    }
  }

  void update(std::size_t estimator, const UpdateRecord& record) override {
    constexpr double share_of_the_last = 0.01;
    update_us_[estimator] += share_of_the_last * (record.times.update - update_us_[estimator]);
  }

  bool is_complete(double length) const {
    const Eigen::Vector2d here(T_world_robot_.x, T_world_robot_.y);
    return driven_ > 0.8 * length && (here - start_).norm() < 1.0;
  }

  double update_ms(std::size_t estimator) const { return 1e-3 * update_us_[estimator]; }
  const seif::Pose2& T_world_robot() const { return T_world_robot_; }
  std::int64_t landmarks() const { return landmarks_; }

 private:
  Eigen::Vector2d start_;  // [m]
  std::vector<bool> seen_;
  std::vector<double> update_us_;  // mean for each estimator
  double driven_ = 0.0;            // [m]
  std::int64_t landmarks_ = 0;
  seif::Pose2 T_world_robot_;
};

/// The same world in the kinematic engine, which needs only one step for each odometry reading.
worlds::World without_contacts(worlds::World world, double duration) {
  world.physics.engine = worlds::Engine::kinematic;
  world.physics.step_rate = world.encoders.rate;
  world.duration = duration;
  return world;
}

constexpr worlds::Scoring never{.interval = 1e9};

void give_up_if_slow(Believers& believers, const Round& round, double slowest_ms) {
  for (std::size_t i = 0; i < believers.estimators.size(); ++i) {
    LiveEstimator& estimator = believers.estimators[i];
    if (!estimator.failure.empty() || round.update_ms(i) < slowest_ms) continue;
    estimator.failure = fmt::format("given up at {} landmarks: {:.1f} ms each update, {:.0f} MB",
                                    estimator.filter->map().size(), round.update_ms(i),
                                    1e-6 * static_cast<double>(estimator.filter->memory_bytes()));
  }
}

void take_out_failed(WarmStart& warm) {
  for (const LiveEstimator& estimator : warm.believers->estimators) {
    if (!estimator.failure.empty()) warm.given_up.push_back({estimator.name, estimator.failure});
  }
  std::erase_if(warm.believers->estimators, [](const LiveEstimator& e) { return !e.failure.empty(); });
}

}  // namespace

WarmStart warm_start(const worlds::World& world, const seif::Registry& registry,
                     const WarmStartLimits& limits, const std::atomic<bool>& stop,
                     const std::function<void(double t)>& progress) {
  WarmStart warm{.believers = std::make_unique<Believers>(), .given_up = {}, .T_world_robot = {}};
  const double more_than_turning_takes = 60.0 + 1.5 * limits.length / world.drive.speed;  // [s]
  SimulatedStream stream(without_contacts(world, more_than_turning_takes), {});
  warm.believers->estimators = make_estimators(registry, world.estimators, stream.description(), world.seed);
  Round round(world, world.estimators.size());
  LiveLoop loop(stream, *warm.believers, {&round}, stream.description(), never);
  std::atomic<bool> done = false;
  loop.run(done, [&](const LoopCounts& counts) {
    give_up_if_slow(*warm.believers, round, limits.slowest_ms);
    if (stop || round.is_complete(limits.length)) done = true;
    progress(counts.t);
  });
  take_out_failed(warm);
  warm.T_world_robot = round.T_world_robot();
  warm.landmarks = round.landmarks();
  warm.updates = loop.counts().updates;
  return warm;
}

seif::Pose2 drive_on(const worlds::World& world, Believers& believers, std::int64_t updates,
                     const std::atomic<bool>& stop) {
  SimulatedStream stream(without_contacts(world, static_cast<double>(updates) / world.landmark_sensor.rate),
                         {});
  Round round(world, world.estimators.size());
  LiveLoop loop(stream, believers, {&round}, stream.description(), never);
  loop.run(stop, [](const LoopCounts&) {});
  return round.T_world_robot();
}

}  // namespace harness
