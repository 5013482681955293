#include "harness/stress/live_measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/stress/live_place.hpp"

namespace harness {

namespace {

using Clock = std::chrono::steady_clock;

void start_at(worlds::World& world, const seif::Pose2& T_world_robot) {
  world.robot.start = {{T_world_robot.x, T_world_robot.y}, T_world_robot.theta};
  world.seed += 1;  // new noise, not that of the warm start again
}

/// The number of updates to measure at a place.
std::int64_t share_of(std::int64_t updates, std::int64_t place, std::int64_t places) {
  return updates * (place + 1) / places - updates * place / places;
}

LivePlace live_place(const StressPlan& plan, const worlds::World& world, std::int64_t number,
                     std::int64_t updates) {
  LivePlace place{.world = world, .updates = updates, .folder = plan.folder / fmt::format("{}", number + 1)};
  place.world.duration = static_cast<double>(updates) / world.landmark_sensor.rate;
  if (plan.world.pattern == StressPattern::forest) place.world.drive.mode = worlds::DriveMode::explore;
  place.has_covariances = number + 1 == plan.places && plan.world.landmarks <= plan.covariances_up_to;
  place.quiet = plan.quiet;
  return place;
}

/// Measures at all places, with one estimator or none. Between two places it drives on as in a warm start.
LiveSamples measure_places(const StressPlan& plan, worlds::World world, const WarmStart& warm,
                           Believers& believers, const std::atomic<bool>& stop) {
  LiveSamples all(plan.updates, world);
  start_at(world, warm.T_world_robot);
  for (std::int64_t i = 0; i < plan.places && !stop; ++i) {
    const std::int64_t updates = share_of(plan.updates, i, plan.places);
    all.add(measure_place(live_place(plan, world, i, updates), believers, plan.after_each_update, stop));
    start_at(world, all.T_world_robot);
    const std::int64_t to_next = share_of(warm.updates, i, plan.places) - updates;
    if (i + 1 == plan.places || to_next <= 0) continue;
    start_at(world, drive_on(world, believers, to_next, stop));
  }
  return all;
}

void describe(const LiveSamples& samples, double scan_rate, StressRow& row) {
  const auto times_rate = [&](std::optional<Percentiles> us) {
    if (us) *us = {us->p50 * scan_rate, us->p95 * scan_rate, us->p99 * scan_rate, us->max * scan_rate};
    return us;
  };
  const auto sorted = [](std::vector<double> us) { return percentiles(us); };
  row.build_s = samples.build_s;
  row.updates = samples.updates;
  row.step_us = sorted(samples.step_us);
  row.scan_us = sorted(samples.scan_us);
  row.rest_us = sorted(samples.rest_us);
  row.second_us = times_rate(sorted(samples.cycle_us));
  row.realtime_factor = samples.t / samples.wall_s;
  row.process_bytes = samples.process_bytes;
  row.growth_bytes_by_hour = samples.growth_bytes * 3600 / (0.8 * samples.t);
  row.counts = samples.counts;
}

std::optional<double> aligned_rmse(std::span<const seif::LandmarkEstimate> map, const worlds::World& world) {
  std::vector<PointPair> pairs;
  for (const seif::LandmarkEstimate& landmark : map) {
    pairs.push_back(
        {landmark.mean, world.landmarks.at(static_cast<std::size_t>(landmark.landmark)).position});
  }
  return score_points(pairs).rmse_aligned;
}

StressEstimator described(const StressPlan& plan, const LiveEstimator& estimator, LiveSamples samples,
                          const worlds::World& world) {
  StressEstimator result;
  result.name = estimator.name;
  result.skipped = estimator.failure;
  if (estimator.name != plan.reference) {
    result.update_us = percentiles(samples.update_us);
    result.blocks = percentiles(samples.blocks);
  }
  if (!estimator.failure.empty()) return result;
  const Clock::time_point begin = Clock::now();
  const std::vector<seif::LandmarkEstimate> map = estimator.filter->map();
  result.map_read_s = std::chrono::duration<double>(Clock::now() - begin).count();
  result.landmarks = std::ssize(map);
  result.bytes = static_cast<double>(estimator.filter->memory_bytes());
  result.map_rmse = aligned_rmse(map, world);
  result.nees_pose = samples.nees_pose;
  result.nees_landmark = samples.nees_landmark;
  return result;
}

/// Divides the others' map errors by that of the reference.
void compare_with(const std::string& reference, std::vector<StressEstimator>& estimators) {
  const auto it = std::ranges::find(estimators, reference, &StressEstimator::name);
  if (it == estimators.end() || !it->map_rmse) return;
  for (StressEstimator& estimator : estimators) {
    if (estimator.name != reference && estimator.map_rmse)
      estimator.over_reference = *estimator.map_rmse / *it->map_rmse;
  }
}

}  // namespace

void measure_live(const StressPlan& plan, const worlds::World& world, WarmStart& warm,
                  const std::atomic<bool>& stop, StressRow& row) {
  std::vector<LiveEstimator>& estimators = warm.believers->estimators;
  std::vector<StressEstimator> measured;
  // In reverse order, because the row's own values are those of the first estimator.
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
    LiveSamples samples = measure_places(its_plan, world, warm, alone, stop);
    if (stop) return;
    describe(samples, world.landmark_sensor.rate, row);
    if (!alone.estimators.empty())
      measured.push_back(described(plan, alone.estimators.front(), std::move(samples), world));
  }
  compare_with(plan.reference, measured);
  row.estimators.insert(row.estimators.begin(), measured.rbegin(), measured.rend());
}

}  // namespace harness
