#include "harness/paper/paper_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/comparison/comparison_keys.hpp"

namespace harness {
namespace {

EstimatorScore score(const std::string& name, double rmse, double nees, int links) {
  EstimatorScore score;
  score.name = name;
  score.landmarks = {rmse, rmse / 2};
  score.nees_pose_final = nees;
  score.nees_landmark_final = 2 * nees;
  score.links = links;
  score.update_us = Percentiles{20.0, 0.0, 50.0, 0.0};
  return score;
}

/// Three runs, with squared errors of 1, 4, 9 and of 4, 16, 36 [1e-3 m^2]. For 1, 4, 9 the mean is 14/3 and the
/// standard deviation 7/sqrt(3), so the standard error is 7/3. Student's quantile with two degrees of freedom
/// is 4.302653.
Comparison example() {
  Comparison comparison;
  comparison.name = "example";
  comparison.baseline = "ekf";
  for (int i = 1; i <= 3; ++i) {
    RunResult result;
    result.summary.updates = 500;
    const double rmse = i / std::sqrt(1000.0);
    result.summary.score.estimators = {score("ekf", rmse, 1.0, 1275),
                                       score("seif_report", 2 * rmse, i, 500 + i),
                                       score("mine", rmse, 1.0, 7)};
    result.summary.failures = {"", "", i == 2 ? "at 5 s: gave up" : ""};
    comparison.runs.push_back({"example-" + std::to_string(i), result});
  }
  compare_estimators(comparison);
  return comparison;
}

worlds::World world() {
  worlds::World world;
  world.landmarks.resize(50);
  world.physics.engine = worlds::Engine::kinematic;
  world.estimators.resize(1);
  world.estimators.front().name = "seif_report";
  world.estimators.front().options = {{"theta_x", std::int64_t{6}}, {"K", std::int64_t{10}}};
  return world;
}

std::string line_with(const std::string& text, const std::string& beginning, int which) {
  std::size_t at = 0;
  for (int i = 0; i < which; ++i) at = text.find(beginning, at + 1);
  return text.substr(at, text.find('\n', at) - at);
}

void expect_in(const std::string& line, const std::vector<std::string>& cells) {
  std::size_t at = 0;
  for (const std::string& cell : cells) {
    const std::size_t found = line.find("  " + cell, at);
    EXPECT_NE(found, std::string::npos) << cell << " in: " << line;
    if (found != std::string::npos) at = found + cell.size();
  }
}

TEST(PaperReport, PutsTheReportsFiguresBesideOurs) {
  const std::string text = paper_board({}, world(), example());
  EXPECT_NE(
      text.find("example: 50 landmarks, 500 updates, theta_x = 6, K = 10, kinematic, 3 runs from seed 1"),
      std::string::npos)
      << text;
  // 14/3 times exp(-+ 4.302653 / 2).
  expect_in(line_with(text, "EKF (ekf)", 1),
            {"3", "0", "4.67", "0.54 to 40.12", "4.00", "5.54 +- 0.67", "1.000"});
  // Fieller's interval is unbounded: the EKF's mean, 14/3, is less than 4.302653 * 7/3.
  expect_in(line_with(text, "SEIF, constant time", 1),
            {"3", "0", "18.67", "2.17 to 160.46", "16.00", "6.35 +- 0.67", "4.000", "-", "1.146", "4.000",
             "4.000 to 4.000", "2.000"});
  expect_in(line_with(text, "EKF (ekf)", 2),
            {"1275.0", "1275.0 to 1275.0", "1275", "20.0", "O(N^2)", "O(N^2)"});
  // 502 times exp(-+ 4.302653 / sqrt(3) / 502).
  expect_in(line_with(text, "SEIF, constant time", 2),
            {"502.0", "499.5 to 504.5", "549 +- 1.59", "20.0", "O(1)"});
  // 2 times exp(-+ 4.302653 / sqrt(3) / 2).
  expect_in(line_with(text, "SEIF, constant time", 3), {"2.00", "0.58 to 6.93", "4.00", "1.16 to 13.85"});
}

TEST(PaperReport, SaysWhatItsColumnsMeanAndWhatFailed) {
  const std::string text = paper_board({}, world(), example());
  for (const char* word : {"\nerror ", "\nlinks ", "\nNEES ", "\n95 % ", "\nupdate "})
    EXPECT_NE(text.find(word), std::string::npos) << word;
  expect_in(line_with(text, "mine", 1), {"2", "1", "5.00"});  // of 1 and 9
  EXPECT_TRUE(text.ends_with("example-2: mine failed at 5 s: gave up\n")) << text;
}

TEST(PaperReport, JsonHasWhatTheTableHasAndNothingFromAClock) {
  const std::string text = paper_json({}, world(), example());
  const nlohmann::json json = nlohmann::json::parse(text);
  EXPECT_EQ(json["runs"], 3);
  EXPECT_EQ(json["engine"], "kinematic");
  const nlohmann::json& ekf = json["estimators"]["ekf"];
  EXPECT_NEAR(ekf["landmark_mse_m2"]["value"], 14e-3 / 3, 1e-12);
  EXPECT_NEAR(ekf["landmark_mse_m2"]["low"], 14.0 / 3 * std::exp(-4.302653 / 2) * 1e-3, 1e-8);
  EXPECT_NEAR(ekf["landmark_mse_m2"]["high"], 14.0 / 3 * std::exp(4.302653 / 2) * 1e-3, 1e-8);
  EXPECT_NEAR(ekf["report"]["error"], 5.54e-3, 1e-12);
  EXPECT_TRUE(ekf["report"]["links_half_interval"].is_null());
  const nlohmann::json& seif = json["estimators"]["seif_report"];
  EXPECT_NEAR(seif["report"]["error_over_ekf"], 1.1462, 1e-4);
  EXPECT_EQ(seif["report"]["links_half_interval"], 1.59);
  EXPECT_EQ(seif["nees_pose_final"]["value"], 2.0);
  EXPECT_TRUE(json["estimators"]["mine"]["report"].is_null());
  EXPECT_EQ(text.find("_us"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(paper_times_json({}, example()))["estimators"]["ekf"]["update_p50_us"],
            20.0);
}

TEST(PaperReport, HasARowForEachRunAndEstimator) {
  Comparison comparison = example();
  comparison.runs.resize(1);
  comparison.runs[0].result.summary.score.estimators = {score("ekf", 0.5, 1.25, 1275),
                                                        score("mine", 2.0, 3.0, 7)};
  comparison.runs[0].result.summary.score.estimators[1].nees_pose_final.reset();
  EXPECT_EQ(paper_runs_csv(comparison),
            "run,estimator,landmark_rmse_m,landmark_rmse_aligned_m,links,nees_pose,nees_landmark\n"
            "example-1,ekf,0.5,0.25,1275,1.25,2.5\n"
            "example-1,mine,2,1,7,,6\n");
}

TEST(PaperReport, HasATableWithoutRuns) {
  Comparison none;
  none.name = "none";
  none.interrupted = true;
  EXPECT_NE(paper_board({}, world(), none).find("0 runs from seed 1 (interrupted)"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::parse(paper_json({}, world(), none))["estimators"].empty());
}

TEST(PaperTables, AreTheSameFromTheFilesOfTheFolder) {
  const Comparison comparison = example();
  Comparison read = parse_comparison(paper_json({}, world(), comparison));
  const nlohmann::ordered_json times = nlohmann::ordered_json::parse(paper_times_json({}, comparison));
  for (EstimatorComparison& estimator : read.estimators)
    read_comparison_keys(times.at("estimators").at(estimator.name).dump(), estimator);
  EXPECT_EQ(paper_tables(read), paper_tables(comparison)) << "is a key missing in comparison_keys.cpp?";
}

}  // namespace
}  // namespace harness
