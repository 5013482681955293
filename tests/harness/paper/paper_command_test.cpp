// `seifbed paper` on the command line, and when it is stopped.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::call;
using test::Called;
using test::read_file;

const std::string small = "paper --set duration_s=3 --set sensors.landmark_sensor.max_range_m=4 ";

TEST(PaperCommand, TheAggregateAndTheFiguresHaveTheSameBytesWhateverTheJobs) {
  const TemporaryFolder folder;
  const Called one = call(folder, small + "--runs 3 --jobs 1 --out one");
  EXPECT_EQ(one.exit_code, 0) << one.errors;
  EXPECT_EQ(one.output, read_file(folder / "one" / "paper.txt") + "\nWritten to one\n");
  EXPECT_EQ(call(folder, small + "--runs 3 --jobs 3 --out three --quiet").output, "");
  for (const char* file :
       {"paper.json", "runs.csv", "world.yaml", "figure1.svg", "figure2.svg", "figure6.png"})
    EXPECT_EQ(read_file(folder / "one" / file), read_file(folder / "three" / file)) << file;
}

TEST(PaperCommand, JsonIsAllThatIsPrintedAndARunOfItsWorldIsOneOfItsRuns) {
  const TemporaryFolder folder;
  const Called called = call(folder, small + "--runs 1 --seed 5 --json");
  EXPECT_EQ(called.exit_code, 0) << called.errors;
  EXPECT_EQ(called.output, read_file(folder / "runs" / "paper" / "paper.json"));
  const nlohmann::json json = nlohmann::json::parse(called.output);
  EXPECT_EQ(json["first_seed"], 5);
  const nlohmann::json run = nlohmann::json::parse(call(folder, "run runs/paper/world.yaml --json").output);
  EXPECT_EQ(run["seed"], 5);
  for (const auto& [name, score] : run["estimators"].items()) {
    const double rmse = score["landmark_rmse_m"];
    const nlohmann::json& row = json["estimators"][name];
    EXPECT_DOUBLE_EQ(row["landmark_mse_m2"]["value"], rmse * rmse) << name;
    EXPECT_EQ(row["links"]["value"], score["links"]) << name;
    EXPECT_EQ(row["nees_pose_final"]["value"], score["nees_pose_final"]) << name;
    EXPECT_TRUE(row["links"]["low"].is_null()) << "one run has no interval";
  }
}

TEST(PaperCommand, RunsInBullet) {
  const TemporaryFolder folder;
  const Called called = call(folder, small + "--runs 1 --physics");
  EXPECT_EQ(called.exit_code, 0) << called.errors;
  EXPECT_NE(called.output.find("15 updates, theta_x = 6, K = 10, in Bullet, 1 runs"), std::string::npos)
      << called.output;
}

TEST(PaperCommand, AnInterruptLeavesTheTableOfTheRunsThatHaveEnded) {
  const TemporaryFolder folder;
  const std::string out = (folder / "cut").string();
  std::vector<std::string> arguments = {SEIFBED_PROGRAM,
                                        "paper",
                                        "--runs",
                                        "1000000",
                                        "--quiet",
                                        "--jobs",
                                        "2",
                                        "--out",
                                        out,
                                        "--set",
                                        "duration_s=1",
                                        "--set",
                                        "estimators={ekf: {}}"};
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  ASSERT_EQ(posix_spawn(&child, SEIFBED_PROGRAM, nullptr, nullptr, pointers.data(), environ), 0);
  // From then on the program handles the signal.
  while (!std::filesystem::exists(folder / "cut" / "world.yaml"))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const nlohmann::json json = nlohmann::json::parse(read_file(folder / "cut" / "paper.json"));
  EXPECT_EQ(json["interrupted"], true);
  EXPECT_LT(json["runs"], 1'000'000);
  EXPECT_FALSE(std::filesystem::exists(folder / "cut" / "figure1.png"));
  EXPECT_NE(read_file(folder / "cut" / "paper.txt").find("(interrupted)"), std::string::npos);
}

}  // namespace
}  // namespace harness
