#include "harness/score/details.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/command_call.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"
#include "harness/score/score_folder.hpp"

namespace harness {
namespace {

using test::read_file;

const std::vector<std::string> names = {"ekf", "seif_report"};

class ScoreOfRun : public testing::Test {
 protected:
  ScoreOfRun() { summary = test::run_live(test::small_world(), run).summary; }

  const TemporaryFolder folder;
  const std::filesystem::path run = folder / "run";
  Summary summary;
};

TEST_F(ScoreOfRun, ASummaryComesBackFromItsFolder) {
  Summary read = read_summary(run / "summary.json");
  read.score = score_folder(run, names, read.rpe_interval);
  EXPECT_EQ(to_json(read), read_file(run / "summary.json"));
  std::filesystem::remove(run / "summary.json");
  EXPECT_THROW(read_summary(run / "summary.json"), BadInput);
  test::write_file(run / "summary.json", "{}");
  EXPECT_THROW(read_summary(run / "summary.json"), BadInput);
}

TEST_F(ScoreOfRun, CountsWhatTheMapLacksAndHasTooMuch) {
  const MapCounts before = *score_details(run, names, {}).estimators[0].map;
  EXPECT_EQ(before.missed, 0);
  EXPECT_EQ(before.spurious, 0);
  // The first landmark of the map gets an id that the world does not have.
  std::string map = read_file(run / "ekf_map.csv");
  const std::size_t row = map.find('\n') + 1;
  map.replace(row, map.find(',', row) - row, "999");
  test::write_file(run / "ekf_map.csv", map);
  const RunDetails details = score_details(run, names, {});
  EXPECT_EQ(details.estimators[0].map->missed, 1);
  EXPECT_EQ(details.estimators[0].map->spurious, 1);
  EXPECT_EQ(details.estimators[0].map->duplicate, 0) << "it stands where no other does";
  EXPECT_EQ(details.estimators[1].map->missed, 0);
}

TEST_F(ScoreOfRun, WithoutTruthNothingIsKnown) {
  for (const char* file : {"truth.csv", "landmarks.csv"}) std::filesystem::remove(run / file);
  std::filesystem::create_directories(folder / "replay");
  const EstimatorDetails details = score_details(run, names, {}).estimators[0];
  EXPECT_FALSE(details.map);
  EXPECT_FALSE(details.landmark_rmse_from_robot);
  EXPECT_FALSE(details.landmarks_inside);
  EXPECT_FALSE(details.rpe[0].translation);
  EXPECT_FALSE(details.closure_error[0]);
}

TEST_F(ScoreOfRun, TakesTheDistancesAndTheAbsenceThatItIsTold) {
  DetailChoices choices;
  choices.distances = {0.5, 1000.0};
  choices.away = 5.0;
  const RunDetails details = score_details(run, names, choices);
  EXPECT_TRUE(details.odometry.rpe[0].translation);
  EXPECT_FALSE(details.odometry.rpe[1].translation);
  EXPECT_GT(details.closures, 0U);
  EXPECT_EQ(score_details(run, names, {.distances = {}, .away = 1e6, .consistency = {}}).closures, 0U);
}

TEST_F(ScoreOfRun, SharesAreOfTheMomentsThatTheConsistencyHas) {
  test::write_file(run / "ekf_consistency.csv",
                   "t,nees_pose,nees_landmark,landmarks_scored,landmarks_mapped,memory_bytes\n"
                   "5,0.05,1,1,1,1\n10,0.08,1,1,1,1\n15,3.1,1,1,1,1\n20,3.2,1,1,1,1\n25,,1,1,1,1\n");
  const EstimatorDetails details = score_details(run, names, {}).estimators[0];
  EXPECT_EQ(details.poses_scored, 4U);
  EXPECT_EQ(details.pose_inside, 0.5) << "the band is 0.0719 to 3.1161";
}

class ScoreCommand : public testing::Test {
 protected:
  ScoreCommand() {
    test::write_file(folder / "world.yaml",
                     "duration_s: 20\n"
                     "physics: {engine: kinematic}\n"
                     "landmarks: {generators: [{type: uniform, count: 20}]}\n"
                     "drive: {mode: loop, waypoints_m: [[3, 3], [-3, 3], [-3, -3], [3, -3]]}\n"
                     "estimators: {ekf: {}, seif_report: {}}\n");
    test::call(folder, "run world.yaml --out run --quiet");
  }

  nlohmann::json score(const std::string& options) const {
    const test::Called called = test::call(folder, "score run --json " + options);
    EXPECT_EQ(called.exit_code, 0) << called.errors;
    return nlohmann::json::parse(called.output);
  }

  const TemporaryFolder folder;
};

TEST_F(ScoreCommand, SaysWhatTheSummarySaysAndMore) {
  const nlohmann::json json = score("");
  const nlohmann::json summary = nlohmann::json::parse(read_file(folder / "run" / "summary.json"));
  for (const auto& [key, value] : summary["estimators"]["ekf"].items())
    EXPECT_EQ(json["estimators"]["ekf"][key], value) << key;
  EXPECT_EQ(json["trajectory_hash"], summary["trajectory_hash"]);
  EXPECT_EQ(json["estimators"]["ekf"]["rpe_along_path"].size(), 3U);
  EXPECT_EQ(json["odometry"]["rpe_along_path"].size(), 3U);
}

TEST_F(ScoreCommand, EveryUpdateIsScoredByReplayingTheRun) {
  const std::string truth = read_file(folder / "run" / "ekf_consistency.csv");
  const nlohmann::json json = score("--every-update");
  for (const std::string& name : names)
    EXPECT_EQ(json["estimators"][name]["nees_pose_inside_of"], json["updates"]) << name;
  EXPECT_EQ(read_file(folder / "run" / "ekf_consistency.csv"), truth) << "the run is left as it was";
}

TEST_F(ScoreCommand, ARunThatDoesNotReplayToTheSameIsAnError) {
  std::string summary = read_file(folder / "run" / "summary.json");
  summary.replace(summary.find("trajectory_hash") + 19, 4, "0000");
  test::write_file(folder / "run" / "summary.json", summary);
  const test::Called called = test::call(folder, "score run --every-update");
  EXPECT_EQ(called.exit_code, 1);
  EXPECT_NE(called.errors.find("does not replay to the same"), std::string::npos) << called.errors;
}

TEST_F(ScoreCommand, GoesWithoutAReplayThatDoesNotComeToTheSame) {
  std::string summary = read_file(folder / "run" / "summary.json");
  summary.replace(summary.find("trajectory_hash") + 19, 4, "0000");
  test::write_file(folder / "run" / "summary.json", summary);
  const test::Called called = test::call(folder, "score run --json");
  EXPECT_EQ(called.exit_code, 0);
  EXPECT_NE(called.errors.find("does not replay to the same"), std::string::npos) << called.errors;
  EXPECT_TRUE(nlohmann::json::parse(called.output)["estimators"]["ekf"]["nis"].is_null());
}

TEST_F(ScoreCommand, RebuildsByAReplayWhatTheFolderDoesNotHold) {
  const nlohmann::json ekf = score("")["estimators"]["ekf"];
  for (const char* key : {"nis", "nis_inside", "nees_landmark_from_robot", "nees_landmark_from_robot_final",
                          "nees_landmark_from_robot_inside", "nis_scan", "nis_scan_inside"})
    EXPECT_TRUE(ekf[key].is_number()) << key;
  const nlohmann::json at_every_update = score("--every-update")["estimators"]["ekf"];
  EXPECT_GT(at_every_update["nis_inside_of"], 10 * ekf["nis_inside_of"].get<int>());
  EXPECT_EQ(at_every_update["nees_landmark_from_robot_final"], ekf["nees_landmark_from_robot_final"]);
  const nlohmann::json without = score("--no-replay")["estimators"]["ekf"];
  EXPECT_TRUE(without["nis"].is_null());
  EXPECT_EQ(without["nis_inside_of"], 0);
  EXPECT_EQ(without["nees_pose"], ekf["nees_pose"]);
}

TEST_F(ScoreCommand, TheReferenceIsTheOptimumThatARunWithItHas) {
  const nlohmann::json json = score("--reference batch");
  const nlohmann::json& reference = json["estimators"]["batch"];
  EXPECT_EQ(json["estimators"].size(), 3U);
  test::call(folder, "replay run --estimators batch --out with_it --quiet");
  const nlohmann::json with_it =
      nlohmann::json::parse(read_file(folder / "with_it" / "summary.json"))["estimators"]["batch"];
  for (const char* key : {"landmarks_mapped", "landmark_rmse_m", "landmark_rmse_aligned_m", "nees_pose_final",
                          "nees_landmark_final"})
    EXPECT_EQ(reference[key], with_it[key]) << key;
  EXPECT_TRUE(reference["nees_landmark_from_robot_final"].is_number());
  EXPECT_TRUE(reference["update_us"]["p50"].is_null()) << "the times of its guide are not its own";
  EXPECT_NE(reference["ate_rmse_m"], with_it["ate_rmse_m"]) << "the trajectory is the optimum's";
  EXPECT_LT(reference["rpe_trans_m"], with_it["rpe_trans_m"]) << "which looks ahead";
}

TEST_F(ScoreCommand, AMissingReferenceLeavesTheOtherScores) {
  test::call(folder, "run world.yaml --set sensors.landmark_sensor.ids=hidden --out nameless --quiet");
  const test::Called called = test::call(folder, "score nameless --json --reference batch");
  EXPECT_EQ(called.exit_code, 1);
  const char* why = "the observations do not name their landmarks";
  EXPECT_EQ(called.errors, fmt::format("seifbed: the reference batch is missing: {}\n", why));
  const nlohmann::json json = nlohmann::json::parse(called.output);
  EXPECT_EQ(json["missing_references"], (nlohmann::json{{"batch", why}}));
  EXPECT_TRUE(json["estimators"]["ekf"]["nees_pose"].is_number());
  EXPECT_FALSE(json["estimators"].contains("batch"));
  const std::string board = test::call(folder, "score nameless --reference batch").output;
  EXPECT_NE(board.find(fmt::format("\nThe reference batch is missing: {}\n", why)), std::string::npos);
}

TEST_F(ScoreCommand, ThePeerIsAReferenceWithItsTimes) {
  const test::Called called = test::call(folder, "score run --json --reference batch,mrpt_ekf");
  if (called.exit_code == 2) {
    EXPECT_NE(called.errors.find("libmrpt-slam-dev"), std::string::npos) << called.errors;
    GTEST_SKIP() << "built without MRPT: " << called.errors;
  }
  const nlohmann::json estimators = nlohmann::json::parse(called.output)["estimators"];
  ASSERT_EQ(estimators.size(), 4U);
  const nlohmann::json& peer = estimators["mrpt_ekf"];
  EXPECT_NEAR(peer["landmark_rmse_m"], estimators["ekf"]["landmark_rmse_m"], 1e-4);
  EXPECT_NEAR(peer["nis_scan"], estimators["ekf"]["nis_scan"], 1e-3);
  EXPECT_GT(peer["update_us"]["p50"], 0.0);
}

TEST_F(ScoreCommand, TheReferenceNeedsItsName) {
  test::call(folder, "replay run --estimators batch --out with_it --quiet");
  const test::Called called = test::call(folder, "score with_it --reference batch");
  EXPECT_EQ(called.exit_code, 2);
  EXPECT_NE(called.errors.find("has an estimator of this name"), std::string::npos) << called.errors;
}

TEST_F(ScoreCommand, PrintsTables) {
  const std::string board = test::call(folder, "score run --rpe-m 2").output;
  for (const char* part : {"missed", "RPE along path  2 m [m]", "NIS", "pose inside [%]", "odometry"})
    EXPECT_NE(board.find(part), std::string::npos) << board;
}

TEST_F(ScoreCommand, PrintsTheErrorsAfterLoopClosures) {
  EXPECT_NE(test::call(folder, "score run").output.find("No loop closes."), std::string::npos);
  ASSERT_EQ(test::call(folder, "run world.yaml --out long --quiet --set duration_s=120").exit_code, 0);
  const std::string closed = test::call(folder, "score long").output;
  EXPECT_NE(closed.find(" closures\n"), std::string::npos) << closed;
  EXPECT_EQ(closed.find("No loop closes."), std::string::npos) << closed;
}

TEST_F(ScoreCommand, BadInputEndsWithCodeTwo) {
  for (const char* arguments : {"score nothing", "score run --rpe-m 0", "score run --away-s -1", "score",
                                "score run --reference best", "score run --every-update --no-replay"})
    EXPECT_EQ(test::call(folder, arguments).exit_code, 2) << arguments;
}

}  // namespace
}  // namespace harness
