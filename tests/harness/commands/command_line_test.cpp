// The program on the command line: exit codes, and which output goes to which stream.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "harness/command_call.hpp"
#include "harness/estimators/registry.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::call;
using test::Called;
using test::read_file;
using test::write_file;

void write_world(const TemporaryFolder& folder) {
  write_file(folder / "world.yaml",
             "name: small\n"
             "seed: 5\n"
             "duration_s: 10\n"
             "landmarks: {generators: [{type: uniform, count: 20}]}\n"
             "drive: {mode: commands, file: mine/told.csv}\n"
             "estimators: {ekf: {}, seif_report: {}}\n");
  std::filesystem::create_directories(folder / "mine");
  write_file(folder / "mine" / "told.csv", "t,v,omega\n0,0.5,0.1\n5,0.3,-0.4\n");
}

std::string hash_of(const std::string& json) { return nlohmann::json::parse(json).at("trajectory_hash"); }

TEST(CommandLine, JsonIsAllThatIsPrinted) {
  const TemporaryFolder folder;
  write_world(folder);
  const Called run = call(folder, "run world.yaml --json");
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_EQ(run.errors, "");
  EXPECT_EQ(run.output, read_file(folder / "runs" / "small-5" / "summary.json"));
  EXPECT_EQ(nlohmann::json::parse(run.output).at("seed"), 5);
}

TEST(CommandLine, ARunFolderRunsAndReplaysAgainWithoutItsSources) {
  const TemporaryFolder folder;
  write_world(folder);
  const std::string hash = hash_of(call(folder, "run world.yaml --json --out first").output);
  std::filesystem::remove_all(folder / "mine");
  EXPECT_EQ(hash_of(call(folder, "run first/world.yaml --json --out second").output), hash);
  EXPECT_EQ(hash_of(call(folder, "replay second --json --out third").output), hash);
  EXPECT_EQ(hash_of(call(folder, "replay third --json --out fourth").output), hash);
}

TEST(CommandLine, AReplayTakesTheEstimatorsThatItIsTold) {
  const TemporaryFolder folder;
  write_world(folder);
  call(folder, "run world.yaml --quiet --out run");
  const Called replay =
      call(folder, "replay run --estimators ekf --set estimators.ekf.odometry_sd_factor=3 --json");
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  const nlohmann::json estimators = nlohmann::json::parse(replay.output).at("estimators");
  EXPECT_EQ(estimators.size(), 1U);
  EXPECT_TRUE(estimators.contains("ekf"));
  EXPECT_NE(read_file(folder / "runs" / "small-replay" / "ekf.tum"), read_file(folder / "run" / "ekf.tum"));
}

TEST(CommandLine, ALogWithoutWorldRunsTheBaselineTheReportsFilterAndOurs) {
  const TemporaryFolder folder;
  write_world(folder);
  call(folder, "run world.yaml --quiet --out run");
  std::filesystem::remove(folder / "run" / "world.yaml");
  const Called replay = call(folder, "replay run --json --seed 5");
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  const nlohmann::json estimators = nlohmann::json::parse(replay.output).at("estimators");
  EXPECT_EQ(estimators.size(), 3U);
  for (const char* name : {"ekf", "seif", "seif_report"}) EXPECT_TRUE(estimators.contains(name)) << name;
}

/// The summary without times.
nlohmann::json without_times(nlohmann::json json) {
  if (json.is_object()) {
    for (const char* key : {"update_us", "stage_us", "update_p50_us", "update_p99_us", "realtime_factor"})
      json.erase(key);
  }
  if (json.is_structured()) {
    for (nlohmann::json& part : json) part = without_times(part);
  }
  return json;
}

nlohmann::json compare(const TemporaryFolder& folder, const std::string& arguments) {
  const Called called = call(folder, "compare " + arguments + " --json");
  EXPECT_EQ(called.exit_code, 0) << called.errors;
  EXPECT_EQ(called.errors, "");
  return without_times(nlohmann::json::parse(called.output));
}

TEST(CommandLine, AComparisonIsTheSameWithOneJobAndWithMany) {
  const TemporaryFolder folder;
  write_world(folder);
  const std::string arguments = "world.yaml --seeds 2..4,6 --baseline batch";
  const nlohmann::json one = compare(folder, arguments + " --jobs 1");
  EXPECT_EQ(compare(folder, arguments + " --jobs 3"), one);
  EXPECT_EQ(one["runs"].size(), 4U);
  EXPECT_EQ(one["runs"][3]["name"], "small-6");
  EXPECT_EQ(one["baseline"], "batch");
  EXPECT_EQ(one["estimators"].size(), 3U) << "the baseline joins the world's own";
  EXPECT_EQ(one["estimators"]["batch"]["landmark_mse_ratio"]["value"], 1.0);
}

TEST(CommandLine, AComparisonKeepsRunsThatReplayToTheSame) {
  const TemporaryFolder folder;
  write_world(folder);
  const nlohmann::json live = compare(folder, "world.yaml --seeds 1,2 --keep kept");
  EXPECT_EQ(live["runs"][0]["summary"]["trajectory_hash"],
            hash_of(call(folder, "run world.yaml --seed 1 --json").output));
  EXPECT_EQ(compare(folder, "kept/small-1 kept/small-2")["estimators"], live["estimators"]);
  const nlohmann::json ekf = compare(folder, "kept/small-1 kept/small-2 --estimators ekf")["estimators"];
  EXPECT_EQ(ekf.size(), 1U);
  EXPECT_EQ(ekf["ekf"]["nees_pose_final"], live["estimators"]["ekf"]["nees_pose_final"]);
}

TEST(CommandLine, AComparisonOfLogsTakesItsBaselineBesideTheEstimatorsThatItIsTold) {
  const TemporaryFolder folder;
  write_world(folder);
  call(folder, "run world.yaml --quiet --out run");
  const nlohmann::json both = compare(folder, "run --estimators seif_report --baseline ekf");
  EXPECT_EQ(both["baseline"], "ekf");
  EXPECT_EQ(both["estimators"].size(), 2U);
}

TEST(CommandLine, LogsThatHaveNoBaselineInCommonAreNotCompared) {
  const TemporaryFolder folder;
  write_world(folder);
  call(folder, "run world.yaml --quiet --out one");
  call(folder, "run world.yaml --quiet --out other --set 'estimators={seif_report: {}}'");
  const Called called = call(folder, "compare one other");
  EXPECT_EQ(called.exit_code, 2);
  EXPECT_EQ(called.errors, "other: has no estimator 'ekf' to compare with\n");
}

TEST(CommandLine, AReplayRefusesWhatItCannotSet) {
  const TemporaryFolder folder;
  write_world(folder);
  call(folder, "run world.yaml --quiet --out run");
  for (const auto& [arguments, complaint] : {
           std::pair{"--set physics.engine=kinematic", "--set physics.engine=kinematic: a replay can set "},
           std::pair{"--set scoring=4", "'scoring' must be a map, not '4'"},
           std::pair{"--estimators walnut", "--estimators: there is no estimator 'walnut'"},
           std::pair{"--set estimators.ekf.gate=walnut", "'gate' must be a number, not 'walnut'"},
       }) {
    for (const char* command : {"replay run ", "compare run "}) {
      const Called called = call(folder, std::string(command) + arguments);
      EXPECT_EQ(called.exit_code, 2) << command << arguments;
      EXPECT_NE(called.errors.find(complaint), std::string::npos) << called.errors;
    }
  }
}

TEST(CommandLine, AReplaySetsWholeSectionsAndNoise) {
  const TemporaryFolder folder;
  write_world(folder);
  call(folder, "run world.yaml --quiet --out run");
  int number = 0;
  for (const char* set : {"'estimators={ekf: {}, seif: {}}'", "'scoring={interval_s: 2}'",
                          "'film={speed: 2}'", "'noise={range_sd_m: 0.1, bearing_sd_rad: 0.02}'"}) {
    const std::string out = " --out again" + std::to_string(++number);
    const Called called = call(folder, std::string("replay run --quiet --set ") + set + out);
    EXPECT_EQ(called.exit_code, 0) << called.errors;
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "again1" / "seif_map.csv"));
  const Called half = call(folder, "replay run --quiet --set noise.range_sd_m=0.1");
  EXPECT_EQ(half.exit_code, 2);
  EXPECT_NE(half.errors.find("--set noise.range_sd_m=0.1 --set noise.bearing_sd_rad="), std::string::npos);
}

/// Replaces a line of a file.
void spoil_line(const std::filesystem::path& file, int number) {
  std::istringstream lines(read_file(file));
  std::string text;
  for (std::string line; std::getline(lines, line);) text += (--number == 0 ? "garbage" : line) + '\n';
  test::write_file(file, text);
}

TEST(CommandLine, ALogThatIsRefusedInItsMiddleLeavesAFolderThatSaysSo) {
  const TemporaryFolder folder;
  write_world(folder);
  ASSERT_EQ(call(folder, "run world.yaml --quiet --out run").exit_code, 0);
  spoil_line(folder / "run" / "odometry.csv", 30);
  const Called replay = call(folder, "replay run --out part");
  EXPECT_EQ(replay.exit_code, 2);
  EXPECT_EQ(replay.output, "") << "no scoreboard";
  const std::string error = "run/odometry.csv:30:1: t: 'garbage' is not a number";
  EXPECT_TRUE(replay.errors.starts_with(error + "\n")) << replay.errors;
  const auto summary = nlohmann::json::parse(read_file(folder / "part" / "summary.json"));
  EXPECT_EQ(summary["interrupted"], true);
  EXPECT_EQ(summary["error"], error);
  const Called score = call(folder, "score part");
  EXPECT_EQ(score.exit_code, 0);
  EXPECT_NE(score.errors.find(error), std::string::npos) << score.errors;
  const Called whole = call(folder, "score run");
  EXPECT_EQ(whole.exit_code, 2);
  EXPECT_NE(whole.errors.find("no NIS and no NEES from the robot: " + error), std::string::npos)
      << whole.errors;
}

TEST(CommandLine, ALogThatIsRefusedBeforeItsFirstScanLeavesNothing) {
  const TemporaryFolder folder;
  write_world(folder);
  ASSERT_EQ(call(folder, "run world.yaml --quiet --out run").exit_code, 0);
  spoil_line(folder / "run" / "odometry.csv", 3);
  const Called replay = call(folder, "replay run --out part");
  EXPECT_EQ(replay.exit_code, 2);
  EXPECT_EQ(replay.output, "");
  EXPECT_EQ(replay.errors, "run/odometry.csv:3:1: t: 'garbage' is not a number\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "part"));
}

TEST(CommandLine, OnATerminalARunSaysHowFarItIsAndWipesThatAway) {
  const TemporaryFolder folder;
  write_world(folder);
  const std::string script = "script --quiet --return --command '" SEIFBED_PROGRAM " ";
  const Called run = test::call_program(folder, script + "run world.yaml --set duration_s=300' /dev/null");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find(" of 300.0 s, "), std::string::npos) << run.output;
  const Called compared =
      test::call_program(folder, script + "compare world.yaml --seeds 1..6 --set duration_s=60' /dev/null");
  EXPECT_EQ(compared.exit_code, 0) << compared.output;
  EXPECT_NE(compared.output.find(" of 6 runs, "), std::string::npos) << compared.output;
  for (const Called* called : {&run, &compared})
    EXPECT_LT(called->output.rfind(" s left"), called->output.rfind("\r\033[K")) << called->output;
}

TEST(CommandLine, AMeasurementThatIsNoneIsToldOnceAndCountedInTheFolder) {
  const TemporaryFolder folder;
  write_world(folder);
  const Called run = call(folder,
                          "run world.yaml --out run --set 'faults=[{kind: bad_observation, at_s: 3}, "
                          "{kind: bad_observation, at_s: 6}]'");
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  const std::size_t told = run.errors.find("an invalid measurement was ignored");
  EXPECT_NE(told, std::string::npos) << run.errors;
  EXPECT_EQ(told, run.errors.rfind("an invalid measurement was ignored"));
  EXPECT_TRUE(run.errors.starts_with("at 3")) << run.errors;
  const auto summary = nlohmann::json::parse(read_file(folder / "run" / "summary.json"));
  const Called score = call(folder, "score run --json");
  EXPECT_EQ(score.exit_code, 0) << score.errors;
  EXPECT_EQ(nlohmann::json::parse(score.output).at("left_out"), summary.at("left_out"));
  EXPECT_NEAR(summary.at("left_out").at("first_s").get<double>(), 3.0, 0.5);
}

TEST(CommandLine, AComparisonLeavesNothingBehind) {
  const TemporaryFolder folder;
  write_world(folder);
  std::filesystem::create_directories(folder / "temporary");
  const Called called =
      call(folder, "compare world.yaml --seeds 1..2 --set duration_s=2", "TMPDIR=$PWD/temporary");
  EXPECT_EQ(called.exit_code, 0) << called.errors;
  EXPECT_NE(called.output.find("small, 2 runs"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "temporary"));
  EXPECT_FALSE(std::filesystem::exists(folder / "runs"));
}

TEST(CommandLine, QuietPrintsNothing) {
  const TemporaryFolder folder;
  write_world(folder);
  const Called run = call(folder, "run world.yaml --quiet");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.output + run.errors, "");
}

TEST(CommandLine, AnOutputThatCannotBeWrittenIsAnError) {
  const TemporaryFolder folder;
  write_world(folder);
  EXPECT_EQ(call(folder, "run world.yaml --json > /dev/full").exit_code, 1);
}

struct BadCall {
  const char* arguments;
  const char* complaint;
};

class BadCalls : public testing::TestWithParam<BadCall> {};

TEST_P(BadCalls, EndWithCodeTwoAndAReason) {
  const TemporaryFolder folder;
  write_world(folder);
  std::filesystem::create_directories(folder / "full" / "something");
  const Called called = call(folder, GetParam().arguments);
  EXPECT_EQ(called.exit_code, 2);
  EXPECT_EQ(called.output, "");
  EXPECT_NE(called.errors.find(GetParam().complaint), std::string::npos) << called.errors;
  EXPECT_FALSE(std::filesystem::exists(folder / "runs"));
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, BadCalls,
    testing::Values(
        BadCall{"", "a command is missing"}, BadCall{"run", "WORLD is required"},
        BadCall{"run nothing.yaml", "nothing.yaml"}, BadCall{"run world.yaml --bogus", "--bogus"},
        BadCall{"run world.yaml --seed -1", "--seed: '-1' is not allowed"},
        BadCall{"run world.yaml --out full", "not empty"},
        BadCall{"run world.yaml --set estimators.ekf.bogus=1", "unknown key 'bogus'"},
        BadCall{"run world.yaml --duration -3", "--duration: '-3' is not allowed"},
        BadCall{"run world.yaml --set drive.pose_from=nobody", "nobody"},
        BadCall{"validate nothing.yaml", "nothing.yaml"}, BadCall{"replay nothing", "no such folder"},
        BadCall{"replay full", "odometry.csv: cannot be read"},
        BadCall{"compare nothing.yaml", "nothing.yaml"},
        BadCall{"compare world.yaml --seeds 1..x", "'x' is no seed"},
        BadCall{"compare world.yaml --seeds 5..1", "5..1 is no range"},
        BadCall{"compare world.yaml --seeds 1,", "'' is no seed"},
        BadCall{"compare world.yaml --baseline nobody", "no estimator 'nobody'"},
        BadCall{"compare world.yaml --estimators ekf", "--estimators is for logs"},
        BadCall{"compare world.yaml --jobs 0", "--jobs"},
        BadCall{"compare world.yaml --keep full", "not empty"},
        BadCall{"compare world.yaml world.yaml", "one world file, or log folders"},
        BadCall{"compare full --seeds 1..2", "--seeds is for worlds"}, BadCall{"paper --runs 0", "--runs"},
        BadCall{"paper --runs many", "--runs"}, BadCall{"paper --seed -1", "--seed"},
        BadCall{"paper --jobs 0", "--jobs"}, BadCall{"paper --out full", "not empty"},
        BadCall{"paper --set duration_s=-1", "duration_s"},
        BadCall{"paper --set estimators.seif_report.theta=6", "theta_x"},
        BadCall{"paper --set 'estimators={seif: {}}'", "no estimator 'ekf'"},
        BadCall{"paper world.yaml", "world.yaml"}, BadCall{"compare full", "odometry.csv: cannot be read"}));

TEST(CommandLine, EveryCommandHasHelpWithAnExample) {
  const TemporaryFolder folder;
  for (const std::string command :
       {"run", "replay", "score", "export", "film", "report", "compare", "paper", "stress", "sweep", "merge",
        "validate", "doctor", "schema", "estimators", "help", "completion", "man"}) {
    const Called help = call(folder, command + " --help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.output.find("seifbed " + command), std::string::npos) << command;
  }
  EXPECT_EQ(call(folder, "--version").output.substr(0, 8), "seifbed ");
}

TEST(CommandLine, SchemaIsJsonAndEstimatorsAreListed) {
  const TemporaryFolder folder;
  EXPECT_TRUE(nlohmann::json::parse(call(folder, "schema").output).is_object());
  const std::string list = call(folder, "estimators").output;
  const seif::Registry registry = known_estimators();
  for (const seif::EstimatorType& type : registry.types())
    EXPECT_NE(list.find(type.name + "\n"), std::string::npos);
}

}  // namespace
}  // namespace harness
