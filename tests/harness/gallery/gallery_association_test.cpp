// Courtyard and forest without names: the associations that ekf and seif find by themselves.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/fixtures.hpp"
#include "harness/score/details.hpp"
#include "worlds/load.hpp"

namespace harness {
namespace {

const std::vector<std::string> twice_the_noise = {"sensors.landmark_sensor.range_sd_m=0.1",
                                                  "sensors.landmark_sensor.bearing_sd_deg=1",
                                                  "sensors.encoders.distance_sd_m_per_sqrt_m=0.01"};

struct Outcome {
  std::string name;
  double right = 0.0;  // [-] share of the associations
  int duplicates = 0;  // [-] landmarks at the end
  int mapped = 0;      // [-] landmarks at the end
};

std::vector<Outcome> run_without_names(const std::string& name, std::vector<std::string> overrides,
                                       int seed) {
  overrides.insert(overrides.end(), {"sensors.landmark_sensor.ids=hidden", "scoring.interval_s=1e6"});
  const worlds::LoadResult loaded = worlds::load_world(SEIFBED_SOURCE_DIR "/worlds/" + name + ".yaml",
                                                       overrides, estimator_schemas(test::test_registry()));
  EXPECT_TRUE(loaded.problems.empty());
  worlds::World world = loaded.world.value();
  world.seed = static_cast<std::uint64_t>(seed);
  const TemporaryFolder folder;
  const RunResult result = test::run_live(world, folder / "run");
  EXPECT_EQ(exit_code(result), 0) << result.error;
  std::vector<std::string> names;
  for (const EstimatorScore& score : result.summary.score.estimators) names.push_back(score.name);
  const RunDetails details = score_details(folder / "run", names, {});
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const EstimatorScore& score = result.summary.score.estimators[i];
    outcomes.push_back({names[i], score.associations_right.value(), details.estimators[i].map->duplicate,
                        score.landmarks_mapped.value()});
  }
  return outcomes;
}

const std::vector<std::string> in_courtyard = {
    "estimators={ekf: {association: joint}, seif: {association: joint}, ekf_nearest: {type: ekf, "
    "association: "
    "nearest}, seif_nearest: {type: seif, association: nearest}}"};
/// Lanes through about 500 trees, in an eighth of the time that the whole forest takes.
const std::vector<std::string> in_forest = {
    "estimators={ekf: {association: joint}, seif: {association: joint}}",
    "duration_s=450",
    "landmarks.generators=[{type: poisson_disk, count: 600, distance_m: 1.5, radius_m: 0.15, region: {min_m: "
    "[-33, -33], max_m: [33, 33]}, clear_m: {path: 0.8}}]",
    "robot.start={x_m: -30, y_m: -30, heading_deg: 0}",
    "drive.min_m=[-30, -30]",
    "drive.max_m=[30, 30]"};

std::vector<std::string> with(std::vector<std::string> overrides, const std::vector<std::string>& others) {
  overrides.insert(overrides.end(), others.begin(), others.end());
  return overrides;
}

TEST(NamelessGallery, AtTheDefaultNoiseNinetyNineInAHundredAreRightAndNoLandmarkStandsTwice) {
  const auto check = [](const std::vector<Outcome>& outcomes) {
    for (const Outcome& outcome : outcomes) {
      EXPECT_GE(outcome.right, 0.99) << outcome.name;
      EXPECT_EQ(outcome.duplicates, 0) << outcome.name;
    }
  };
  for (int seed = 1; seed <= 10; ++seed) check(run_without_names("courtyard", in_courtyard, seed));
  check(run_without_names("forest", in_forest, 1));
}

TEST(NamelessGallery, AtTwiceTheNoiseNinetyFiveInAHundredAreRightAndTwoInAHundredStandTwice) {
  const auto check = [](const std::vector<Outcome>& outcomes) {
    for (const Outcome& outcome : outcomes) {
      EXPECT_GE(outcome.right, 0.95) << outcome.name;
      EXPECT_LE(outcome.duplicates, 0.02 * outcome.mapped) << outcome.name;
    }
  };
  for (int seed = 1; seed <= 10; ++seed)
    check(run_without_names("courtyard", with(in_courtyard, twice_the_noise), seed));
  check(run_without_names("forest", with(in_forest, twice_the_noise), 1));
}

}  // namespace
}  // namespace harness
