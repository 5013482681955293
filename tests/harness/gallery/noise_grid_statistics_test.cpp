// From nearly perfect sensors to nearly useless ones: seif stands wherever the EKF does.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/fixtures.hpp"
#include "harness/run/live_loop.hpp"
#include "harness/simulation/simulated_stream.hpp"
#include "worlds/load.hpp"

namespace harness {
namespace {

constexpr int seeds = 10;
constexpr std::array ranges_sd{1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 1.0, 5.0};  // [m]
constexpr std::array bearings_sd{1e-5, 1e-3, 0.01, 0.1, 1.0, 10.0, 60.0};     // [deg]
constexpr double wheel_sd = 0.005;                                            // [m/sqrt(m)] the default

struct Noise {
  double range;    // [m]
  double bearing;  // [deg]
  double wheel;    // [-] times the default
};

/// The NEES per degree of freedom of one filter, means over a run.
class NeesMeter final : public RunListener {
 public:
  void odometry(const OdometryEvent& /*event*/) override {}
  void scan(const ScanEvent& /*event*/) override {}
  void update(std::size_t /*estimator*/, const UpdateRecord& /*record*/) override {}
  void consistency(std::size_t estimator, const ConsistencyRecord& record) override {
    if (estimator >= count_.size() || !record.nees_pose || !record.nees_landmark) return;
    pose_[estimator] += *record.nees_pose;
    map_[estimator] += *record.nees_landmark;
    ++count_[estimator];
  }
  double pose(std::size_t estimator) const { return pose_[estimator] / count_[estimator]; }
  double map(std::size_t estimator) const { return map_[estimator] / count_[estimator]; }

 private:
  std::array<double, 2> pose_{}, map_{};
  std::array<int, 2> count_{};
};

/// Of the seeds that a filter finished.
struct Cell {
  std::vector<double> pose, map;  // NEES [-]
  int failed = 0;
};

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : std::sqrt(values[middle - 1] * values[middle]);
}

worlds::World world_with(const Noise& noise) {
  const std::vector<std::string> overrides{
      "physics.engine=kinematic",
      "scoring.interval_s=20",
      "estimators={ekf: {}, seif: {}}",
      "sensors.landmark_sensor.range_sd_m=" + fmt::format("{}", noise.range),
      "sensors.landmark_sensor.bearing_sd_deg=" + fmt::format("{}", noise.bearing),
      "sensors.encoders.distance_sd_m_per_sqrt_m=" + fmt::format("{}", wheel_sd * noise.wheel)};
  const worlds::LoadResult loaded = worlds::load_world(SEIFBED_SOURCE_DIR "/worlds/report2002.yaml",
                                                       overrides, estimator_schemas(test::test_registry()));
  EXPECT_TRUE(loaded.problems.empty());
  return loaded.world.value();
}

/// ekf and seif.
std::array<Cell, 2> cells_of(const Noise& noise) {
  std::array<Cell, 2> cells;
  worlds::World world = world_with(noise);
  for (int seed = 1; seed <= seeds; ++seed) {
    world.seed = static_cast<std::uint64_t>(seed);
    SimulatedStream stream(world, {});
    Believers believers;
    believers.estimators =
        make_estimators(test::test_registry(), world.estimators, stream.description(), world.seed);
    NeesMeter meter;
    LiveLoop loop(stream, believers, {&meter}, stream.description(), world.scoring);
    const std::atomic<bool> stop = false;
    loop.run(stop, {});
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!believers.estimators[i].failure.empty()) {
        ++cells[i].failed;
        continue;
      }
      cells[i].pose.push_back(meter.pose(i));
      cells[i].map.push_back(meter.map(i));
    }
  }
  return cells;
}

/// Where both are strongly overconfident, as docs/robustness.md says: with a good sensor, and wheels that tell
/// nearly nothing between two scans.
bool is_beyond_use(const Noise& noise) {
  return noise.wheel > 10.0 && noise.range <= 0.1 && noise.bearing <= 0.1;
}

class NoiseGrid : public testing::TestWithParam<double> {};

// Medians of ten seeds. `./test release -R NoiseGrid -V` prints the table of docs/robustness.md.
TEST_P(NoiseGrid, SeifStandsWhereverTheEkfDoes) {
  std::printf("wheel noise x %g: NEES of pose, map; failures\n", GetParam());
  for (const double range : ranges_sd) {
    for (const double bearing : bearings_sd) {
      const Noise noise{range, bearing, GetParam()};
      const auto [ekf, seif] = cells_of(noise);
      std::printf("%g m, %g deg: ekf %.2g, %.2g; %d  seif %.2g, %.2g; %d\n", range, bearing, median(ekf.pose),
                  median(ekf.map), ekf.failed, median(seif.pose), median(seif.map), seif.failed);
      EXPECT_LE(seif.failed, ekf.failed) << range << " m, " << bearing << " deg";
      if (is_beyond_use(noise)) continue;
      EXPECT_LE(median(seif.pose), 2.0 * std::max(1.0, median(ekf.pose)))
          << range << " m, " << bearing << " deg";
      EXPECT_LE(median(seif.map), 2.0 * std::max(1.0, median(ekf.map)))
          << range << " m, " << bearing << " deg";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Wheels, NoiseGrid, testing::Values(0.1, 1.0, 10.0, 100.0));

}  // namespace
}  // namespace harness
