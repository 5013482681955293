#include "harness/stress/stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/stress/live_measure.hpp"
#include "harness/stress/resident_memory.hpp"
#include "harness/stress/warm_start.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/progress.hpp"
#include "harness/terminal/version.hpp"
#include "worlds/load.hpp"

namespace harness {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double length_of(const std::vector<Eigen::Vector2d>& round) {
  double length = (round.front() - round.back()).norm();
  for (std::size_t i = 1; i < round.size(); ++i) length += (round[i] - round[i - 1]).norm();
  return length;
}

/// With the reference among its estimators, if there is one.
StressWorldSpec with_reference(StressWorldSpec spec, const std::string& reference) {
  const bool is_there = std::ranges::find(spec.estimators, reference) != spec.estimators.end();
  if (!reference.empty() && !is_there) spec.estimators.push_back(reference);
  return spec;
}

/// Writes the world file to the row's folder and reads it. The resolved file then replaces it.
worlds::World load(const StressPlan& plan, const seif::Registry& registry) {
  const std::filesystem::path file = plan.folder / "world.yaml";
  write_whole_file(file, stress_world(with_reference(plan.world, plan.reference)));
  worlds::LoadResult loaded =
      worlds::load_world(file, plan.overrides, estimator_schemas(registry), program_version());
  if (!loaded.world) throw BadInput(worlds::to_string(loaded.problems.front()));
  refuse_team(*loaded.world, "seifbed stress");
  write_whole_file(file, loaded.resolved);
  return std::move(*loaded.world);
}

bool is_beyond_limit(const StressPlan& plan, const std::string& estimator, std::int64_t landmarks) {
  const auto limit = plan.most_landmarks.find(estimator);
  return limit != plan.most_landmarks.end() && landmarks > limit->second;
}

/// Removes the estimators for which this world is too large.
void skip_beyond_limits(const StressPlan& plan, worlds::World& world, StressRow& row) {
  std::erase_if(world.estimators, [&](const worlds::EstimatorChoice& estimator) {
    if (!is_beyond_limit(plan, estimator.name, plan.world.landmarks)) return false;
    StressEstimator skipped;
    skipped.name = estimator.name;
    skipped.skipped = fmt::format("skipped above {}", plan.most_landmarks.at(estimator.name));
    row.estimators.push_back(skipped);
    return true;
  });
}

/// For each estimator, the cost in the largest world so far.
using Demands = std::map<std::string, std::string>;

/// For an estimator that is skipped because of its limit, tells its cost in the last world in which it ran.
void tell_demands(const StressPlan& plan, StressRow& row, Demands& demands) {
  for (StressEstimator& estimator : row.estimators) {
    if (estimator.update_us) {
      demands[estimator.name] =
          fmt::format("{:.3g} MB and {:.2g} ms each update with {} landmarks", 1e-6 * estimator.bytes,
                      1e-3 * estimator.update_us->p50, row.landmarks);
    } else if (demands.contains(estimator.name) && is_beyond_limit(plan, estimator.name, row.landmarks)) {
      estimator.skipped += ": " + demands[estimator.name];
    }
  }
}

/// An estimator that was given up in one world is skipped in larger worlds.
void skip_larger(StressPlan& plan, const std::string& estimator, std::int64_t landmarks) {
  const auto limit = plan.most_landmarks.try_emplace(estimator, landmarks).first;
  limit->second = std::min(limit->second, landmarks);
}

}  // namespace

StressRow stress_row(const StressPlan& plan, const seif::Registry& registry, const std::atomic<bool>& stop) {
  StressRow row;
  row.landmarks = plan.world.landmarks;
  const double bytes_before = resident_bytes();
  const Clock::time_point load_begin = Clock::now();
  worlds::World world = load(plan, registry);
  row.load_s = seconds_since(load_begin);
  skip_beyond_limits(plan, world, row);

  const Clock::time_point warm_begin = Clock::now();
  const double length = length_of(world.drive.path);
  Progress progress(plan.quiet, 0.0, length / world.drive.speed);
  WarmStart warm = warm_start(world, registry, {.length = length, .slowest_ms = plan.slowest_ms}, stop,
                              [&](double t) { progress.show(t); });
  row.warm_s = seconds_since(warm_begin);
  row.warm_updates = warm.updates;
  row.landmarks_seen = warm.landmarks;
  for (const WarmStart::GivenUp& given_up : warm.given_up) {
    StressEstimator skipped;
    skipped.name = given_up.name;
    skipped.skipped = given_up.why;
    row.estimators.push_back(skipped);
  }
  measure_live(plan, world, warm, stop, row);
  row.bytes_by_landmark = (row.process_bytes - bytes_before) / static_cast<double>(row.landmarks);
  return row;
}

StressResult stress(const StressPlan& plan, const seif::Registry& registry) {
  const InterruptGuard guard;
  StressResult result;
  StressPlan now = plan;
  Demands demands;
  for (const std::int64_t landmarks : plan.landmarks) {
    now.world.landmarks = landmarks;
    now.folder = create_empty_folder(plan.folder / fmt::format("{}", landmarks));
    StressRow row = stress_row(now, registry, InterruptGuard::flag());
    if (InterruptGuard::flag()) {
      result.interrupted = true;
      return result;
    }
    for (const StressEstimator& estimator : row.estimators) {
      if (!estimator.skipped.empty()) skip_larger(now, estimator.name, landmarks);
    }
    tell_demands(now, row, demands);
    result.rows.push_back(std::move(row));
  }
  return result;
}

}  // namespace harness
