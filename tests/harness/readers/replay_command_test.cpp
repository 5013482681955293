// `seifbed replay` and `calibrate` on logs in other formats, on the command line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"
#include "logs.hpp"

namespace harness {
namespace {

using namespace test;

TEST(ReplayOfOtherLogs, WritesARunFolderThatScoresAndExports) {
  const TemporaryFolder folder;
  write_files(folder.path(), isam_files());
  ASSERT_EQ(call(folder, "replay graph.txt --out run --set estimators.seif.gate=50").exit_code, 0);
  const Called score = call(folder, "score run --reference batch");
  EXPECT_EQ(score.exit_code, 0) << score.errors;
  EXPECT_EQ(score.errors, "");  // it replays to the same estimates, from replay.yaml
  EXPECT_NE(score.output.find("from batch"), std::string::npos);
  EXPECT_NE(score.output.find("The log holds no truth of the poses, nor of the landmarks"),
            std::string::npos);
  EXPECT_NE(read_file(folder / "run" / "replay.yaml").find("gate: 50"), std::string::npos);
  ASSERT_EQ(call(folder, "export run --format g2o > again.g2o").exit_code, 0);
  const Called again = call(folder, "replay again.g2o --out again");
  EXPECT_EQ(again.exit_code, 0) << again.errors;
}

TEST(ReplayOfOtherLogs, ShowsWhatItLeftOut) {
  const TemporaryFolder folder;
  write_files(folder / "mrclam", mrclam_files());
  const Called replay = call(folder, "replay mrclam --robot 2 --out run");
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  EXPECT_NE(replay.output.find("unknown_ids 1, robots 1, without_odometry 2"), std::string::npos);
  const auto summary = nlohmann::json::parse(read_file(folder / "run" / "summary.json"));
  EXPECT_EQ(summary["log"]["odometry_gaps"], 1);
  EXPECT_NE(call(folder, "score run").output.find("robots 1"), std::string::npos);
}

TEST(ReplayOfOtherLogs, RefusesWhatIsBrokenOrNamesNoLandmark) {
  const TemporaryFolder folder;
  write_files(folder / "trees", victoria_park_files());
  const Called nameless = call(folder, "replay trees --estimators seif_report");
  EXPECT_EQ(nameless.exit_code, 2);
  EXPECT_NE(nameless.errors.find("do not say which landmark they are of"), std::string::npos);
  EXPECT_TRUE(nameless.errors.ends_with("; type --estimators ekf,seif\n")) << nameless.errors;
  EXPECT_EQ(call(folder, "replay trees --estimators ekf,seif --out run").exit_code, 0);
  write_file(folder / "graph.txt", "ODOMETRY 0 1 1 0 0 1 0 0 1 0 1\nLANDMARK 1 2 far 0 1 0 1\n");
  const Called broken = call(folder, "replay graph.txt");
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_EQ(broken.errors, "graph.txt:2:14: x: 'far' is not a number\n");
  EXPECT_EQ(call(folder, "replay trees --format walnut").exit_code, 2);
}

TEST(Calibrate, PrintsWhatReplayAccepts) {
  const TemporaryFolder folder;
  write_files(folder / "course", freiburg_files());
  ASSERT_EQ(call(folder, "calibrate course > noise.yaml").exit_code, 0);
  const Called replay = call(folder, "replay course --noise noise.yaml --out run");
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  write_files(folder.path(), isam_files());
  const Called unknown = call(folder, "calibrate graph.txt");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.errors.find("must hold the true landmarks"), std::string::npos);
}

}  // namespace
}  // namespace harness
