#include "harness/stress/stress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/csv_reader.hpp"
#include "harness/fixtures.hpp"
#include "harness/stress/stress_report.hpp"

namespace harness {
namespace {

StressPlan small_plan(const TemporaryFolder& folder) {
  StressPlan plan;
  plan.world.estimators = {"seif", "ekf"};
  plan.landmarks = {40, 80};
  plan.updates = 20;
  plan.folder = folder.path();
  plan.quiet = true;
  return plan;
}

TEST(Stress, MeasuresEveryStageOfFiltersThatHoldTheWholeMap) {
  const TemporaryFolder folder;
  const StressResult result = stress(small_plan(folder), test::test_registry());
  ASSERT_EQ(result.rows.size(), 2U);
  for (const StressRow& row : result.rows) {
    EXPECT_EQ(row.updates, 20);
    EXPECT_EQ(row.counts.steps, 4 * 240);
    EXPECT_EQ(row.landmarks_seen, row.landmarks);
    EXPECT_GT(row.counts.rays, row.updates);
    EXPECT_GT(row.second_us->p50, row.step_us->p50);
    EXPECT_GT(row.scan_us->p50, 0.0);
    EXPECT_GE(row.rest_us->p50, 0.0);
    EXPECT_GT(row.realtime_factor, 0.0);
    ASSERT_EQ(row.estimators.size(), 2U);
    for (const StressEstimator& estimator : row.estimators) {
      EXPECT_EQ(estimator.skipped, "");
      EXPECT_EQ(estimator.landmarks, row.landmarks);
      EXPECT_GT(estimator.update_us->p50, 0.0);
      EXPECT_GT(estimator.blocks->p50, 0.0);
      EXPECT_LT(estimator.map_rmse.value(), 0.5);
      EXPECT_GT(estimator.nees_pose.value(), 0.0);
      EXPECT_GT(estimator.nees_landmark.value(), 0.0);
      EXPECT_GT(estimator.map_read_s.value(), 0.0);
    }
  }
}

TEST(Stress, AMapThatIsTooLargeForCovariancesHasTheNeesOfThePoseAlone) {
  const TemporaryFolder folder;
  StressPlan plan = small_plan(folder);
  plan.covariances_up_to = 40;
  const StressResult result = stress(plan, test::test_registry());
  for (std::size_t i = 0; i < 2; ++i) {
    const StressEstimator& small = result.rows[0].estimators[i];
    const StressEstimator& large = result.rows[1].estimators[i];
    EXPECT_TRUE(small.nees_landmark) << small.name;
    EXPECT_FALSE(large.nees_landmark) << large.name;
    EXPECT_GT(large.nees_pose.value(), 0.0) << large.name;
    EXPECT_GT(large.map_rmse.value(), 0.0) << large.name;
  }
}

TEST(Stress, AnInterruptedRowIsNotScored) {
  const TemporaryFolder folder;
  StressPlan plan = small_plan(folder);
  plan.world.landmarks = 40;
  std::atomic<bool> stop = false;
  int updates = 0;
  plan.after_each_update = [&] { stop = ++updates == 5; };
  const StressRow row = stress_row(plan, test::test_registry(), stop);
  EXPECT_EQ(updates, 5);
  EXPECT_TRUE(row.estimators.empty());
}

TEST(Stress, RecordsWhatItMeasures) {
  const TemporaryFolder folder;
  StressPlan plan = small_plan(folder);
  plan.landmarks = {40};
  stress(plan, test::test_registry());
  for (const char* file :
       {"40/world.yaml", "40/seif/1/observations.csv", "40/seif/10/seif_times.csv", "40/ekf/1/ekf_steps.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
}

/// The first position of the robot.
Eigen::Vector2d start_of(const std::filesystem::path& run) {
  CsvReader reader(run / "truth.csv",
                   {.required = {"t", "x", "y", "theta"}, .optional = {"left_wheel", "right_wheel"}});
  EXPECT_TRUE(reader.next());
  return {reader.number(1), reader.number(2)};
}

TEST(Stress, MeasuresAtPlacesAllAlongTheSecondRound) {
  const TemporaryFolder folder;
  StressPlan plan = small_plan(folder);
  plan.world.pattern = StressPattern::ring;
  plan.landmarks = {40};
  plan.places = 3;
  const StressResult result = stress(plan, test::test_registry());
  EXPECT_EQ(result.rows[0].updates, 20) << "no fewer for not being a multiple of the places";
  for (const char* estimator : {"seif", "ekf"}) {
    const std::filesystem::path runs = folder / "40" / estimator;
    const Eigen::Vector2d first = start_of(runs / "1");
    const Eigen::Vector2d second = start_of(runs / "2");
    const Eigen::Vector2d third = start_of(runs / "3");
    EXPECT_GT((second - first).norm(), 10.0);
    EXPECT_GT((third - second).norm(), 10.0);
    EXPECT_GT((first - third).norm(), 10.0);
  }
  EXPECT_LT(result.rows[0].estimators[0].map_rmse.value(), 0.5) << "it goes on between them";
}

TEST(Stress, SkipsEstimatorsBeyondTheirLimitAndSaysSo) {
  const TemporaryFolder folder;
  StressPlan plan = small_plan(folder);
  plan.most_landmarks = {{"ekf", 40}};
  const StressResult result = stress(plan, test::test_registry());
  EXPECT_EQ(result.rows[0].estimators[1].skipped, "");
  const auto& estimators = result.rows[1].estimators;
  const auto ekf = std::ranges::find(estimators, "ekf", &StressEstimator::name);
  ASSERT_NE(ekf, estimators.end());
  EXPECT_TRUE(ekf->skipped.starts_with("skipped above 40: 0.")) << ekf->skipped;
  EXPECT_TRUE(ekf->skipped.ends_with(" ms each update with 40 landmarks")) << ekf->skipped;
  EXPECT_FALSE(ekf->update_us);
  EXPECT_NE(stress_tables(plan, result).find("80 landmarks, ekf: skipped above 40"), std::string::npos);
}

TEST(Stress, TellsHowFarMapsAreFromThatOfAReferenceAndTellsNoTimesOfIt) {
  const TemporaryFolder folder;
  StressPlan plan = small_plan(folder);
  plan.landmarks = {40};
  const StressRow plain = stress(plan, test::test_registry()).rows.at(0);
  const TemporaryFolder compared_folder;
  plan.folder = compared_folder.path();
  plan.reference = "batch";
  const StressResult result = stress(plan, test::test_registry());
  const std::vector<StressEstimator>& estimators = result.rows.at(0).estimators;
  ASSERT_EQ(estimators.size(), 3U);
  const StressEstimator& batch = estimators[2];
  EXPECT_EQ(batch.name, "batch");
  EXPECT_FALSE(batch.update_us || batch.blocks || batch.over_reference);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(estimators[i].map_rmse, plain.estimators[i].map_rmse) << "a reference changes no other";
    EXPECT_DOUBLE_EQ(estimators[i].over_reference.value(), *estimators[i].map_rmse / *batch.map_rmse);
  }
  EXPECT_NE(stress_tables(plan, result).find("x reference"), std::string::npos);
  EXPECT_EQ(stress_tables(plan, result).find("batch update"), std::string::npos);
  const nlohmann::json json = nlohmann::json::parse(to_json(plan, result));
  EXPECT_EQ(json["reference"], "batch");
  EXPECT_EQ(json["rows"][0]["estimators"]["seif"]["aligned_over_reference"],
            estimators[0].over_reference.value());
}

TEST(Stress, GivesUpOnEstimatorsThatTakeTooLongInThisAndInLargerWorlds) {
  const TemporaryFolder folder;
  StressPlan plan = small_plan(folder);
  plan.slowest_ms = 1e-4;
  const StressResult result = stress(plan, test::test_registry());
  for (const StressEstimator& estimator : result.rows[0].estimators)
    EXPECT_TRUE(estimator.skipped.starts_with("given up at ")) << estimator.skipped;
  for (const StressEstimator& estimator : result.rows[1].estimators)
    EXPECT_EQ(estimator.skipped, "skipped above 40");
  EXPECT_GT(result.rows[1].step_us->p50, 0.0) << "the rest is measured all the same";
}

TEST(Stress, TellsTheSameAsJson) {
  const TemporaryFolder folder;
  const StressPlan plan = small_plan(folder);
  const StressResult result = stress(plan, test::test_registry());
  const nlohmann::json json = nlohmann::json::parse(to_json(plan, result));
  EXPECT_EQ(json["rows"][1]["landmarks"], 80);
  EXPECT_EQ(json["rows"][1]["physics_step_us"]["p99"], result.rows[1].step_us->p99);
  EXPECT_EQ(json["rows"][1]["estimators"]["seif"]["landmarks"], 80);
  EXPECT_TRUE(json["slopes"]["simulated second"]["value"].is_number());
  EXPECT_TRUE(json["slopes"]["seif"]["low"].is_null()) << "two points leave no room for an interval";
}

TEST(Stress, RefusesAWorldThatCannotBe) {
  const TemporaryFolder folder;
  StressPlan plan = small_plan(folder);
  plan.overrides = {"sensors.landmark_sensor.rate_hz=7"};
  EXPECT_THROW(stress(plan, test::test_registry()), BadInput);
}

}  // namespace
}  // namespace harness
