// `seifbed sweep` and `seifbed merge` on the command line, and when they are killed.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::call;
using test::Called;
using test::read_file;
using test::write_file;

constexpr const char* arguments = "sweep world.yaml --seeds 1..8 --vary estimators.seif_report.theta_x=3,6 ";

void write_world(const TemporaryFolder& folder) {
  write_file(
      folder / "world.yaml",
      "name: small\n"
      "duration_s: 2\n"
      "physics: {engine: kinematic}\n"
      "landmarks: {generators: [{type: uniform, count: 20, region: {min_m: [-6, -6], max_m: [6, 6]}}]}\n"
      "drive: {mode: loop, waypoints_m: [[3, 3], [-3, 3], [-3, -3], [3, -3]]}\n"
      "estimators: {ekf: {}, seif_report: {}}\n");
}

/// The bytes of all tables that contain no times.
std::map<std::string, std::string> tables(const TemporaryFolder& folder, const std::string& sweep) {
  std::map<std::string, std::string> bytes;
  for (const char* name : {"runs.csv", "aggregate.csv", "aggregate.json", "sweep.json", "world.yaml"})
    bytes[name] = read_file(folder / sweep / name);
  return bytes;
}

/// The names of the tables in which two sweeps differ.
std::vector<std::string> differing(const TemporaryFolder& folder, const std::string& sweep,
                                   const std::map<std::string, std::string>& other) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : tables(folder, sweep)) {
    if (bytes != other.at(name)) names.push_back(name);
  }
  return names;
}

const std::vector<std::string> none;

std::map<std::string, std::string> whole(const TemporaryFolder& folder) {
  const Called called = call(folder, std::string(arguments) + "--out whole");
  EXPECT_EQ(called.exit_code, 0) << called.errors;
  EXPECT_NE(called.output.find("small, seeds 1..8, 2 settings, 16 runs, 0 of them failed"), std::string::npos)
      << called.output;
  return tables(folder, "whole");
}

std::size_t count(const std::string& text, char c) {
  return static_cast<std::size_t>(std::ranges::count(text, c));
}

TEST(SweepCommand, TheTablesHaveTheSameBytesWhateverTheJobs) {
  const TemporaryFolder folder;
  write_world(folder);
  const std::map<std::string, std::string> one = whole(folder);
  EXPECT_EQ(call(folder, std::string(arguments) + "--jobs 2 --out two --quiet").exit_code, 0);
  EXPECT_EQ(differing(folder, "two", one), none);
  EXPECT_EQ(count(one.at("runs.csv"), '\n'), 1U + 16U * 3U) << "two estimators and odometry";
  EXPECT_EQ(count(read_file(folder / "whole" / "times.csv"), '\n'), 1U + 16U * 3U);
  EXPECT_EQ(one.at("runs.csv").find("_us"), std::string::npos);
}

TEST(SweepCommand, ARunOfItIsTheRunOfThatSeed) {
  const TemporaryFolder folder;
  write_world(folder);
  const std::string runs = whole(folder).at("runs.csv");
  const Called run = call(folder, "run world.yaml --seed 3 --set estimators.seif_report.theta_x=6 --json");
  const std::string hash = run.output.substr(run.output.find("trajectory_hash") + 19, 16);
  const std::size_t row = runs.find("\n10,6,3,seif_report,,");
  ASSERT_NE(row, std::string::npos);
  EXPECT_NE(runs.substr(row, runs.find('\n', row + 1) - row).find(hash), std::string::npos) << hash;
}

/// The summary without times.
nlohmann::json without_times(nlohmann::json summary) {
  summary.erase("realtime_factor");
  for (nlohmann::json& estimator : summary["estimators"]) {
    for (const char* key : {"update_us", "stage_us"}) estimator.erase(key);
  }
  return summary;
}

TEST(SweepCommand, ACellSaysOfItsRunAllThatScoreSays) {
  const TemporaryFolder folder;
  write_world(folder);
  const std::string settings = " --set duration_s=20 --set scoring.landmark_sample=7 ";
  call(folder, "sweep world.yaml --seeds 3 --out sweep --quiet" + settings);
  call(folder, "run world.yaml --seed 3 --out run --quiet" + settings);
  const nlohmann::json cell = nlohmann::json::parse(read_file(folder / "sweep" / "cells" / "000000.json"));
  const nlohmann::json score = nlohmann::json::parse(call(folder, "score run --json").output);
  EXPECT_GT(cell["estimators"]["ekf"]["nis_scan_inside_of"], 0);
  EXPECT_TRUE(cell["estimators"]["ekf"]["nees_landmark_from_robot"].is_number());
  EXPECT_EQ(without_times(cell), without_times(score));
  const std::string header = read_file(folder / "sweep" / "runs.csv");
  for (const char* column :
       {",landmarks_missed,", ",landmarks_duplicate,", ",nis_scan,", ",loop_closures,",
        ",nees_landmark_from_robot_final,", ",rpe_along_path_5_trans_m,", ",loop_closure_error_m_10,"})
    EXPECT_NE(header.find(column), std::string::npos) << column;
}

TEST(SweepCommand, ShardsInAnyOrderMergeToTheWhole) {
  const TemporaryFolder folder;
  write_world(folder);
  const std::map<std::string, std::string> one = whole(folder);
  for (const char* shard : {"1", "2", "3"}) {
    const Called called = call(folder, std::string(arguments) + "--shard " + shard + "/3 --out part" + shard);
    EXPECT_EQ(called.exit_code, 0) << called.errors;
    EXPECT_NE(called.output.find("open"), std::string::npos) << called.output;
  }
  const Called early = call(folder, "merge part3 part1 --out all");
  EXPECT_EQ(early.exit_code, 1);
  EXPECT_NE(early.errors.find("11 of 16 runs done, 0 failed, 5 open"), std::string::npos) << early.errors;
  EXPECT_FALSE(std::filesystem::exists(folder / "all" / "runs.csv"));
  EXPECT_EQ(call(folder, "merge part2 --out all --quiet").exit_code, 0);
  EXPECT_EQ(differing(folder, "all", one), none);
  EXPECT_EQ(call(folder, "merge part2 part3 part1 --out again --quiet").exit_code, 0);
  EXPECT_EQ(differing(folder, "again", one), none);
}

TEST(SweepCommand, AFailureIsMergedUnlessTheRunIsThereToo) {
  const TemporaryFolder folder;
  write_world(folder);
  const std::map<std::string, std::string> one = whole(folder);
  for (const char* shard : {"1", "2"})
    call(folder, std::string(arguments) + "--quiet --shard " + shard + "/2 --out part" + shard);
  std::filesystem::copy(folder / "part1", folder / "failed", std::filesystem::copy_options::recursive);
  std::filesystem::rename(folder / "failed/cells/000004.json", folder / "failed/cells/000004.failed");
  const Called failed = call(folder, "merge failed part2 --out all");
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_NE(failed.output.find("16 runs, 1 of them failed"), std::string::npos) << failed.output;
  EXPECT_EQ(call(folder, "merge failed part1 part2 --out mended --quiet").exit_code, 0);
  EXPECT_EQ(differing(folder, "mended", one), none);
}

TEST(SweepCommand, AShardDoesNotAnswerForWhatFailedInAnother) {
  const TemporaryFolder folder;
  write_world(folder);
  const std::string shard = std::string(arguments) + "--out shared --quiet --shard ";
  EXPECT_EQ(call(folder, shard + "1/4").exit_code, 0);
  write_file(folder / "shared/cells/000001.failed", "ended by signal 9 (Killed)");
  EXPECT_EQ(call(folder, shard + "1/4").exit_code, 0);
  EXPECT_EQ(call(folder, "sweep --status shared").exit_code, 1);
}

TEST(SweepCommand, ShardsMayShareAFolder) {
  const TemporaryFolder folder;
  write_world(folder);
  const std::map<std::string, std::string> one = whole(folder);
  const std::string program = "'" SEIFBED_PROGRAM "' ";
  const std::string shard = program + arguments + "--out shared --quiet --shard ";
  const Called both = test::call_program(folder, "(" + shard + "1/2 & " + shard + "2/2 && wait $!)");
  EXPECT_EQ(both.exit_code, 0) << both.errors;
  EXPECT_EQ(call(folder, "merge shared --out shared --quiet").exit_code, 0);
  EXPECT_EQ(differing(folder, "shared", one), none);
}

/// Starts the program, and kills it after some time, alone or with its children. Returns whether it was killed
/// before its end.
bool begin_and_kill(const TemporaryFolder& folder, std::chrono::microseconds after, bool with_children) {
  const pid_t program = fork();
  if (program == 0) {
    setpgid(0, 0);
    std::filesystem::current_path(folder.path());
    execl(SEIFBED_PROGRAM, SEIFBED_PROGRAM, "sweep", "world.yaml", "--seeds", "1..40", "--jobs", "2", "--out",
          "killed", "--quiet", nullptr);
    _exit(1);
  }
  setpgid(program, program);
  usleep(static_cast<unsigned>(after.count()));
  kill(with_children ? -program : program, SIGKILL);
  int status = 0;
  waitpid(program, &status, 0);
  return WIFSIGNALED(status);
}

TEST(SweepCommand, KilledTenTimesItEndsWithTheSameBytes) {
  const TemporaryFolder folder;
  write_world(folder);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(call(folder, "sweep world.yaml --seeds 1..40 --out whole --quiet").exit_code, 0);
  const auto taken =
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin);
  std::mt19937_64 random(20020402);
  std::uniform_int_distribution<std::int64_t> moment(0, taken.count() / 8);  // [us]
  int killed = 0;
  for (int i = 0; i < 10; ++i) {
    const std::chrono::microseconds after(moment(random));
    killed += begin_and_kill(folder, after, i % 2 == 0) ? 1 : 0;
  }
  EXPECT_GE(killed, 6) << "or it has tried little";
  EXPECT_FALSE(std::filesystem::is_empty(folder / "killed" / "cells")) << "or each time too early";
  EXPECT_EQ(call(folder, "sweep world.yaml --seeds 1..40 --jobs 2 --out killed --quiet").exit_code, 0);
  EXPECT_EQ(differing(folder, "killed", tables(folder, "whole")), none);
}

TEST(SweepCommand, WhatIsDoneIsNotDoneAgain) {
  const TemporaryFolder folder;
  write_world(folder);
  whole(folder);
  const std::string times = read_file(folder / "whole" / "times.csv");
  EXPECT_EQ(call(folder, "sweep --status whole").output, "small: 16 of 16 runs done, 0 failed, 0 open\n");
  std::filesystem::remove(folder / "whole" / "runs.csv");
  EXPECT_EQ(call(folder, "sweep --resume whole --quiet").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "whole" / "runs.csv"));
  EXPECT_EQ(read_file(folder / "whole" / "times.csv"), times);
}

TEST(SweepCommand, JsonIsAllThatIsPrinted) {
  const TemporaryFolder folder;
  write_world(folder);
  const Called called = call(folder, "sweep world.yaml --seeds 1,2 --out sweep --json");
  EXPECT_EQ(called.errors, "");
  EXPECT_EQ(called.output, read_file(folder / "sweep" / "aggregate.json"));
}

struct BadSweep {
  const char* arguments;
  const char* complaint;
};

class BadSweeps : public testing::TestWithParam<BadSweep> {};

TEST_P(BadSweeps, EndWithCodeTwoAndAReason) {
  const TemporaryFolder folder;
  write_world(folder);
  std::filesystem::create_directories(folder / "full" / "something");
  call(folder, "sweep world.yaml --seeds 1 --out other --quiet");
  const Called called = call(folder, GetParam().arguments);
  EXPECT_EQ(called.exit_code, 2);
  EXPECT_EQ(called.output, "");
  EXPECT_NE(called.errors.find(GetParam().complaint), std::string::npos) << called.errors;
  EXPECT_FALSE(std::filesystem::exists(folder / "new"));
}

INSTANTIATE_TEST_SUITE_P(
    SweepCommand, BadSweeps,
    testing::Values(
        BadSweep{"sweep --seeds 1..2 --out new", "WORLD is required"},
        BadSweep{"sweep world.yaml --out new", "--seeds is required"},
        BadSweep{"sweep world.yaml --seeds 1..2", "--out is required"},
        BadSweep{"sweep nothing.yaml --seeds 1..2 --out new", "nothing.yaml"},
        BadSweep{"sweep world.yaml --seeds 9..2 --out new", "9..2 is no range"},
        BadSweep{"sweep world.yaml --seeds 1 --vary estimators.seif_report.teta_x=1,2 --out new",
                 "--vary estimators.seif_report.teta_x=1: unknown key 'teta_x' (did you mean 'theta_x'?)"},
        BadSweep{"sweep world.yaml --seeds 1 --vary duration_s=1..4 --out new", "--vary duration_s=1..4: "},
        BadSweep{"sweep world.yaml --seeds 1 --vary duration_s --out new", "what is meant is like"},
        BadSweep{"sweep world.yaml --seeds 1 --shard 3/2 --out new", "what is meant is like 3/16"},
        BadSweep{"sweep world.yaml --seeds 1 --baseline nobody --out new", "no estimator 'nobody'"},
        BadSweep{"sweep world.yaml --seeds 1..2 --out other", "its seeds are 1, and not 1..2"},
        BadSweep{"sweep world.yaml --seeds 1 --out full", "is not empty, and is no folder of a sweep"},
        BadSweep{"sweep --status full", "is no folder of a sweep"},
        BadSweep{"sweep --resume nothing", "is no folder of a sweep"},
        BadSweep{"sweep --resume other --seeds 1..3", "--seeds"},
        BadSweep{"merge other nothing --out new2", "is no folder of a sweep"},
        BadSweep{"merge other", "--out is required"}));

}  // namespace
}  // namespace harness
