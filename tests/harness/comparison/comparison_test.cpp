#include "harness/comparison/comparison.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/command_call.hpp"
#include "harness/comparison/comparison_keys.hpp"
#include "harness/comparison/parallel_runs.hpp"
#include "harness/recording/run_folder.hpp"

namespace harness {
namespace {

EstimatorScore score(const std::string& name, double rmse, double nees, int links) {
  EstimatorScore score;
  score.name = name;
  score.landmarks = {rmse, rmse / 2};
  score.nees_pose_final = nees;
  score.nees_landmark_final = nees / 2;
  score.links = links;
  score.links_max = 2 * links;
  score.relocations = name == "b" ? 25 : 0;
  score.update_us = Percentiles{links / 10.0, 0.0, links / 5.0, 0.0};
  return score;
}

/// Details of two estimators in run `i`. Those of `b` in the second run, in which it fails, must not count.
RunDetails details(int i) {
  RunDetails run;
  for (const char* name : {"a", "b"}) {
    EstimatorDetails& estimator = run.estimators.emplace_back();
    estimator.name = name;
    if (i == 2 && estimator.name == "b") i = 1000;
    estimator.map = MapCounts{.missed = i, .spurious = 2 * i, .duplicate = 3 * i};
    estimator.rebuilt.nees_landmark_from_robot_final = 0.5 * i;
    estimator.rebuilt.scans = {.nis = 1.0 + i, .band = {}, .count = 10, .inside = 0.1 * i};
  }
  return run;
}

/// Two estimators in three runs of 100 updates; `b` has failed in the second.
Comparison example() {
  Comparison comparison;
  comparison.name = "example";
  comparison.baseline = "a";
  for (int i = 1; i <= 3; ++i) {
    RunResult result;
    result.summary.updates = 100;
    result.summary.score.estimators = {score("a", i, 1.0, 10 * i), score("b", 2 * i, 3.0 * i, 20 * i)};
    result.summary.failures = {"", i == 2 ? "at 5 s: gave up" : ""};
    comparison.runs.push_back({"example-" + std::to_string(i), result, details(i)});
  }
  compare_estimators(comparison);
  return comparison;
}

TEST(Comparison, TakesMeansOverTheRunsThatAnEstimatorFinished) {
  const Comparison comparison = example();
  ASSERT_EQ(comparison.estimators.size(), 2U);
  const EstimatorComparison& a = comparison.estimators[0];
  EXPECT_EQ(a.runs, 3);
  EXPECT_EQ(a.failed, 0);
  EXPECT_DOUBLE_EQ(a.landmark_mse->value, (1.0 + 4.0 + 9.0) / 3);
  EXPECT_EQ(a.landmark_mse_median, 4.0);
  EXPECT_DOUBLE_EQ(a.landmark_aligned->value, 1.0);
  EXPECT_DOUBLE_EQ(a.links->value, 20.0);
  EXPECT_EQ(a.links_max, 60.0);
  EXPECT_FALSE(a.relocations_per_update);
  EXPECT_DOUBLE_EQ(*a.update_p50_us, 2.0);

  const EstimatorComparison& b = comparison.estimators[1];
  EXPECT_EQ(b.runs, 2);
  EXPECT_EQ(b.failed, 1);
  EXPECT_DOUBLE_EQ(b.landmark_mse->value, (4.0 + 36.0) / 2);
  EXPECT_EQ(b.landmark_mse_median, 20.0);
  EXPECT_DOUBLE_EQ(b.nees_pose->value, 6.0);
  EXPECT_DOUBLE_EQ(b.nees_landmark->value, 3.0);
  EXPECT_EQ(b.links_max, 120.0);
  EXPECT_DOUBLE_EQ(*b.relocations_per_update, 0.25);
  EXPECT_DOUBLE_EQ(*b.update_p99_us, 8.0);

  EXPECT_DOUBLE_EQ(a.nees_from_robot->value, 1.0);
  EXPECT_DOUBLE_EQ(a.nis_scan->value, 3.0);
  EXPECT_TRUE(a.nis_scan->interval);
  EXPECT_DOUBLE_EQ(*a.nis_scan_inside, 0.2);
  EXPECT_DOUBLE_EQ(*a.landmarks_missed, 2.0);
  EXPECT_DOUBLE_EQ(*b.landmarks_spurious, 4.0);
  EXPECT_DOUBLE_EQ(*b.landmarks_duplicate, 6.0);
  EXPECT_DOUBLE_EQ(b.nees_from_robot->value, 1.0);
}

TEST(Comparison, TakesRatiosOfTheRunsThatBothFinished) {
  const Comparison comparison = example();
  const EstimatorComparison& b = comparison.estimators[1];
  EXPECT_DOUBLE_EQ(b.landmark_mse_ratio->value, 4.0);
  EXPECT_DOUBLE_EQ(b.landmark_mse_ratio_of_means->value, 4.0);  // not 20 / (14/3)
  EXPECT_DOUBLE_EQ(b.aligned_ratio->value, 2.0);
  EXPECT_EQ(b.aligned_ratio_median, 2.0);
  EXPECT_EQ(comparison.estimators[0].landmark_mse_ratio->value, 1.0);
}

TEST(Comparison, ARunThatFailedCountsForAllOfItsEstimators) {
  Comparison comparison = example();
  comparison.estimators.clear();
  comparison.runs[0].result.error = "the log breaks off";
  comparison.runs.push_back({"example-4", {.summary = {}, .error = "cannot begin", .bad_input = false}});
  compare_estimators(comparison);
  EXPECT_EQ(comparison.estimators[0].runs, 2);
  EXPECT_EQ(comparison.estimators[0].failed, 2);
  EXPECT_EQ(comparison.estimators[1].runs, 1);
  EXPECT_EQ(comparison.estimators[1].failed, 3);
  const std::string board = comparison_board(comparison);
  for (const char* line : {"example-1 failed: the log breaks off\n", "example-4 failed: cannot begin\n",
                           "example-2: b failed at 5 s: gave up\n"})
    EXPECT_NE(board.find(line), std::string::npos) << board;
}

TEST(Comparison, NoIntervalReachesBelowZeroWhereARunDiverged) {
  Comparison comparison = example();
  comparison.estimators.clear();
  comparison.runs[1].result.summary.failures = {"", ""};
  comparison.runs[2].result.summary.score.estimators[1] = score("b", 600.0, 9000.0, 60);
  compare_estimators(comparison);
  const EstimatorComparison& b = comparison.estimators[1];
  for (const std::optional<Estimate>* figure : {&b.landmark_mse, &b.landmark_mse_ratio, &b.landmark_aligned,
                                                &b.aligned_ratio, &b.nees_pose, &b.nees_landmark, &b.links})
    EXPECT_GT((*figure)->interval->low, 0.0);
  EXPECT_FALSE(b.landmark_mse_ratio_of_means->interval);
  const std::string board = comparison_board(comparison);
  EXPECT_NE(board.find("95 %: BCa bootstrap"), std::string::npos) << board;
  EXPECT_FALSE(std::regex_search(board, std::regex(" -[0-9]"))) << "a negative number: " << board;
}

TEST(Comparison, JsonHasIntervalsAndEveryRun) {
  const nlohmann::json json = nlohmann::json::parse(to_json(example()));
  EXPECT_EQ(json["baseline"], "a");
  EXPECT_EQ(json["runs"].size(), 3U);
  EXPECT_EQ(json["runs"][2]["summary"]["estimators"]["b"]["landmark_rmse_m"], 6.0);
  EXPECT_EQ(json["runs"][1]["summary"]["estimators"]["b"]["failure"], "at 5 s: gave up");
  const nlohmann::json& mse = json["estimators"]["a"]["landmark_mse_m2"];
  EXPECT_LT(mse["low"], mse["value"]);
  EXPECT_GT(mse["high"], mse["value"]);
  EXPECT_EQ(json["estimators"]["b"]["failed"], 1);
  EXPECT_EQ(json["estimators"]["a"]["nis_scan"]["value"], 3.0);
  EXPECT_EQ(json["runs"][2]["summary"]["estimators"]["b"]["landmarks_missed"], 3);
}

DetailedRun named(const std::string& world) {
  DetailedRun run;
  run.result.summary.world = world;
  return run;
}

TEST(Comparison, IsReadBackAsItWasWritten) {
  const Comparison comparison = example();
  const Comparison read = parse_comparison(to_json(comparison));
  EXPECT_EQ(comparison_board(read), comparison_board(comparison))
      << "is a key missing in comparison_keys.cpp?";
  EXPECT_EQ(read.baseline, "a");
  EXPECT_EQ(read.runs.at(1).result.summary.failures, comparison.runs.at(1).result.summary.failures);
}

TEST(ExecuteAll, KeepsTheOrderWhateverTheThreadsAndCatchesWhatIsThrown) {
  std::vector<PlannedRun> planned;
  for (int i = 0; i < 50; ++i) {
    const std::string name = std::to_string(i);
    planned.push_back({name, [name] {
                         if (name == "7") throw std::runtime_error("seven");
                         return named(name);
                       }});
  }
  for (const int jobs : {1, 4, 100}) {
    const FinishedRuns finished = execute_all(planned, jobs, true);
    EXPECT_FALSE(finished.interrupted);
    ASSERT_EQ(finished.runs.size(), 50U);
    for (std::size_t i = 0; i < finished.runs.size(); ++i) {
      EXPECT_EQ(finished.runs[i].name, std::to_string(i));
      EXPECT_EQ(finished.runs[i].result.summary.world, i == 7 ? "" : std::to_string(i));
      EXPECT_EQ(finished.runs[i].result.error, i == 7 ? "seven" : "");
    }
  }
}

TEST(ExecuteAll, AnInterruptLeavesTheRunsThatHaveEnded) {
  const std::vector<PlannedRun> planned = {{"first", [] { return named("first"); }},
                                           {"second",
                                            [] {
                                              std::raise(SIGINT);
                                              DetailedRun run = named("second");
                                              run.result.summary.interrupted = true;
                                              return run;
                                            }},
                                           {"third", [] { return named("third"); }}};
  const FinishedRuns finished = execute_all(planned, 1, true);
  EXPECT_TRUE(finished.interrupted);
  ASSERT_EQ(finished.runs.size(), 1U);
  EXPECT_EQ(finished.runs[0].name, "first");
}

/// Robot and map turn with the start as one, so an unknown start bends no map. Means of four seeds.
TEST(UnknownStart, BendsNoMap) {
  for (const char* heading : {"60", "180"}) {
    const TemporaryFolder folder;
    const test::Called called = test::call(
        folder, fmt::format("compare {}/worlds/report2002.yaml --seeds 1..4 --duration 100 --json --quiet "
                            "--set physics.engine=kinematic --set start_estimate.heading_sd_deg={} "
                            "--set start_estimate.x_sd_m=10000 --set 'estimators={{ekf: {{}}, seif: {{}}}}'",
                            SEIFBED_SOURCE_DIR, heading));
    ASSERT_EQ(called.exit_code, 0) << called.errors;
    const nlohmann::json seif = nlohmann::json::parse(called.output).at("estimators").at("seif");
    EXPECT_LT(seif.at("landmark_rmse_aligned_ratio").at("value"), 1.1) << heading;
  }
}

}  // namespace
}  // namespace harness
