#include "harness/sweep/aggregate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/csv_writer.hpp"
#include "harness/score/summary.hpp"

namespace harness {
namespace {

EstimatorRow row(const std::string& name, double error, const std::string& failure = "") {
  return {name, failure, {{"error_m", std::to_string(error), error}, {"hash", "ab", {}}}, {}};
}

/// `a` and `b` in four runs. `b` failed in the third, and is larger than `a` by 1, 3 and 5 in the others.
std::vector<std::vector<EstimatorRow>> example() {
  return {{row("a", 1.0), row("b", 2.0)},
          {row("a", 2.0), row("b", 5.0)},
          {row("a", 9.0), row("b", 0.0, "at 3 s: gave up")},
          {row("a", 4.0), row("b", 9.0)}};
}

TEST(Aggregate, MatchesValuesByHand) {
  const std::vector<EstimatorStatistics> all = aggregate_runs(example(), 2, "a");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].runs, 4U);
  EXPECT_EQ(all[0].failed, 2U);
  ASSERT_EQ(all[0].scores.size(), 1U) << "a text is no score";
  const ScoreStatistics& a = all[0].scores[0];
  EXPECT_DOUBLE_EQ(a.mean.value, 4.0);
  EXPECT_DOUBLE_EQ(a.median, 3.0);
  EXPECT_EQ(a.pairs, 0U);
  EXPECT_FALSE(a.difference) << "nothing is compared with itself";

  EXPECT_EQ(all[1].runs, 3U);
  EXPECT_EQ(all[1].failed, 3U);
  const ScoreStatistics& b = all[1].scores[0];
  EXPECT_EQ(b.runs, 3U);
  EXPECT_DOUBLE_EQ(b.mean.value, 16.0 / 3);
  EXPECT_DOUBLE_EQ(b.median, 5.0);
  EXPECT_EQ(b.pairs, 3U);
  // Differences 1, 3, 5: mean 3, standard deviation 2; Student's quantile for 2 degrees of freedom
  // is 4.302653.
  EXPECT_DOUBLE_EQ(b.difference->value, 3.0);
  EXPECT_NEAR(b.difference->interval->low, 3.0 - 4.302653 * 2.0 / std::sqrt(3.0), 1e-5);
  EXPECT_NEAR(b.difference->interval->high, 3.0 + 4.302653 * 2.0 / std::sqrt(3.0), 1e-5);
}

TEST(Aggregate, ReportsSayTheSame) {
  const Aggregate aggregate{{"example", "0.1.0", "a", {1, 2, 3, 4, 5, 6}, {{"x.y", {"[1,2]"}}}},
                            {{4, "gave up"}, {5, "gave up, too"}},
                            {{{"[1,2]"}, aggregate_runs(example(), 2, "a")}}};
  const nlohmann::json json = nlohmann::json::parse(to_json(aggregate));
  EXPECT_EQ(json["failed"][1],
            (nlohmann::json{{"cell", 5}, {"of", "x.y=[1,2] seed=6"}, {"reason", "gave up, too"}}));
  EXPECT_EQ(json["settings"][0]["values"]["x.y"], "[1,2]");
  const nlohmann::json& b = json["settings"][0]["estimators"]["b"];
  EXPECT_EQ(b["failed"], 3);
  EXPECT_EQ(b["scores"]["error_m"]["difference"]["value"], 3.0);
  EXPECT_EQ(json["settings"][0]["estimators"]["a"]["scores"]["error_m"]["difference"], nullptr);
  const std::string csv = to_csv(aggregate);
  EXPECT_NE(csv.find("\n\"[1,2]\",a,4,2,error_m,4,4,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",3,0,,,\n"), std::string::npos) << "median, and no pairs: " << csv;
  const std::string board = aggregate_board(aggregate);
  EXPECT_NE(board.find("x.y=[1,2] seed=6: gave up, too\n"), std::string::npos) << board;
}

TEST(Rows, ScoresAndTimesOfASummaryPartWays) {
  Summary summary;
  summary.updates = 7;
  summary.realtime_factor = 3.5;
  EstimatorScore score;
  score.name = "ekf";
  score.links = 12;
  score.update_us = Percentiles{1, 2, 3, 4};
  summary.score.estimators = {score};
  summary.failures = {"at 5 s: gave up"};
  const std::vector<EstimatorRow> rows = rows_of(to_json(summary), "summary.json");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].estimator, "ekf");
  EXPECT_EQ(rows[0].failure, "at 5 s: gave up");
  EXPECT_EQ(rows[1].estimator, "odometry");
  const auto text = [](const std::vector<NamedValue>& values, const std::string& name) -> std::string {
    for (const NamedValue& value : values) {
      if (value.name == name) return value.text;
    }
    return "none";
  };
  EXPECT_EQ(text(rows[0].scores, "links"), "12");
  EXPECT_EQ(text(rows[0].scores, "updates"), "7");
  EXPECT_EQ(text(rows[0].scores, "nees_pose"), "");
  EXPECT_EQ(text(rows[0].times, "update_us_p99"), "3.0");
  EXPECT_EQ(text(rows[1].times, "realtime_factor"), "3.5");
  for (const EstimatorRow& row : rows) {
    for (const NamedValue& value : row.scores)
      EXPECT_EQ(value.name.find("_us"), std::string::npos) << value.name;
  }
  EXPECT_THROW(rows_of("{}", "summary.json"), BadInput);
}

TEST(CsvCell, IsQuotedWhereItNeedsThat) {
  EXPECT_EQ(csv_cell("plain text"), "plain text");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"a\"\n"), "\"say \"\"a\"\"\n\"");
}

}  // namespace
}  // namespace harness
