// The map and the belief where a round closes, beside the least-squares optimum of the same data. Bounds
// hold for several seeds together, since a single run scatters widely.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/statistics/statistics.hpp"
#include "harness/stress/stress.hpp"

namespace harness {
namespace {

/// One value for each seed.
struct Closings {
  std::vector<double> over_optimum;  // [-] aligned map error over that of the optimum
  std::vector<double> nees_pose;     // [-]
  std::vector<double> nees_map;      // [-]
};

struct Round {
  StressPattern pattern = StressPattern::ring;
  std::int64_t landmarks = 500;
  std::vector<std::string> settings;  // of the world
  std::int64_t updates = 100;         // [-] after the first round
};

StressPlan plan_of(const Round& round, std::uint64_t seed, const TemporaryFolder& folder) {
  StressPlan plan;
  plan.world = {.pattern = round.pattern, .landmarks = round.landmarks, .seed = seed, .estimators = {"seif"}};
  plan.reference = "batch";
  plan.overrides = round.settings;
  plan.updates = round.updates;
  plan.places = 1;
  plan.folder = folder.path();
  plan.quiet = true;
  return plan;
}

Closings close(const Round& round, std::uint64_t seeds = 6) {
  Closings closings;
  const std::atomic<bool> stop = false;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const TemporaryFolder folder;
    const StressRow row = stress_row(plan_of(round, seed, folder), test::test_registry(), stop);
    const StressEstimator& seif = row.estimators.at(0);
    closings.over_optimum.push_back(seif.over_reference.value());
    closings.nees_pose.push_back(seif.nees_pose.value());
    closings.nees_map.push_back(seif.nees_landmark.value());
  }
  return closings;
}

std::vector<std::string> noise(const std::string& distance_sd, const std::string& bearing_sd_deg,
                               const std::string& range_sd) {
  return {"sensors.encoders.distance_sd_m_per_sqrt_m=" + distance_sd,
          "sensors.landmark_sensor.bearing_sd_deg=" + bearing_sd_deg,
          "sensors.landmark_sensor.range_sd_m=" + range_sd};
}

double mean(const std::vector<double>& values) { return mean_of(values).value().value; }
double median(const std::vector<double>& values) { return median_of(values).value(); }

TEST(Closing, ARingThatIsOffByAHundredthOfARadianHasTheOptimumsMapAndBelief) {
  const Closings closings = close({.settings = noise("0.005", "0.2", "0.01")});
  EXPECT_LT(mean(closings.over_optimum), 1.1);  // 0.99
  EXPECT_LT(mean(closings.nees_pose), 2.0);     // 1.1
  EXPECT_LT(mean(closings.nees_map), 1.5);      // 0.6
}

TEST(Closing, ARingThatIsOffByATenthOfARadianHasNearlyTheOptimumsMapAndBelief) {
  const Closings closings = close({.settings = noise("0.02", "2", "0.05")});
  EXPECT_LT(median(closings.over_optimum), 1.3);  // 0.97
  EXPECT_LT(mean(closings.nees_pose), 2.5);       // 1.2
  EXPECT_LT(mean(closings.nees_map), 2.0);        // 0.9
}

// With half a radian, what is linearised once is wrong in second order: on some seeds `seif` is overconfident of
// its map (NEES up to 15).
TEST(Closing, ARingThatIsOffByHalfARadianComesWithinTwiceTheOptimumsError) {
  const Closings closings = close({.settings = noise("0.05", "10", "0.3")});
  EXPECT_LT(median(closings.over_optimum), 2.0);  // 1.2
  EXPECT_LT(median(closings.nees_pose), 3.0);     // 1.6
}

TEST(Closing, TenRoundsOneAfterTheOtherKeepTheOptimumsMap) {
  const std::int64_t ten_rounds = 8'500;
  const Closings closings =
      close({.landmarks = 100, .settings = {"physics.engine=kinematic"}, .updates = ten_rounds}, 2);
  EXPECT_LT(mean(closings.over_optimum), 1.25);  // 0.95
  EXPECT_LT(mean(closings.nees_map), 3.0);       // 0.9
}

TEST(Closing, AnAreaHasTheOptimumsMapAndAnHonestBelief) {
  const Closings closings = close({.pattern = StressPattern::serpentine, .landmarks = 1'000, .settings = {}});
  EXPECT_LT(*std::ranges::max_element(closings.over_optimum), 1.15);  // 1.02
  for (const double nees : {mean(closings.nees_pose), mean(closings.nees_map)}) {
    EXPECT_GT(nees, 0.3);  // 0.7, 0.8
    EXPECT_LT(nees, 1.8);
  }
}

}  // namespace
}  // namespace harness
