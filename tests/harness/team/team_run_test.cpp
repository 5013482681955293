// Runs of several robots, as people call them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

namespace fs = std::filesystem;
using test::call;
using test::Called;
using test::read_file;

class TeamRun : public testing::Test {
 protected:
  void SetUp() override {
    std::string text =
        "name: crowd\n"
        "duration_s: 20\n"
        "ground: {size_m: [30, 30]}\n"
        "landmarks: {generators: [{type: uniform, count: 60}]}\n"
        "scoring: {interval_s: 5}\n"
        "estimators: {ekf: {}}\n"
        "robots:\n";
    for (int i = 0; i < 8; ++i)
      text += "  - {name: r" + std::to_string(i) + ", start: {x_m: " + std::to_string(3 * (i % 4) - 6) +
              ", y_m: " + std::to_string(4 * (i / 4) - 2) + "}, drive: {mode: explore, pose_from: ekf}}\n";
    test::write_file(folder_ / "world.yaml", text);
  }

  /// All files below the folder that hold no times of updates.
  static std::set<std::string> files_of(const fs::path& run) {
    std::set<std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(run)) {
      const std::string name = fs::relative(entry.path(), run).string();
      if (entry.is_regular_file() && !name.ends_with("summary.json") && !name.ends_with("_times.csv"))
        files.insert(name);
    }
    return files;
  }

  void expect_same_bytes(const std::string& a, const std::string& b) const {
    const std::set<std::string> files = files_of(folder_ / a);
    EXPECT_EQ(files, files_of(folder_ / b));
    for (const std::string& file : files)
      EXPECT_EQ(read_file(folder_ / a / file), read_file(folder_ / b / file)) << file;
  }

  /// Options for robots that tell each other what they learn.
  static std::string exchanging() {
    return " --set 'estimators={ekf: {}, multi_seif: {tell_after: 20, listen_after: 10}}'";
  }

  static std::string hash_of(const fs::path& run) {
    return nlohmann::json::parse(read_file(run / "summary.json")).at("trajectory_hash");
  }

  const TemporaryFolder folder_;
};

TEST_F(TeamRun, GivesEachRobotARunOfItsOwn) {
  const Called run = call(folder_, "run world.yaml --json --out run");
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  const nlohmann::json summary = nlohmann::json::parse(run.output);
  EXPECT_EQ(summary.at("robots").size(), 8U);
  EXPECT_FALSE(summary.at("interrupted").get<bool>());
  std::set<std::string> hashes;
  for (const auto& [name, robot] : summary.at("robots").items()) {
    EXPECT_EQ(robot.at("updates"), 100) << name;
    EXPECT_LT(robot.at("estimators").at("ekf").at("ate_rmse_m"), 0.5) << name;
    EXPECT_EQ(robot.at("trajectory_hash"), hash_of(folder_ / "run" / name));
    hashes.insert(robot.at("trajectory_hash").get<std::string>());
  }
  EXPECT_EQ(hashes.size(), 8U);  // each has random numbers and a way of its own
  const Called scored = call(folder_, "score run/r3 --json");
  EXPECT_EQ(scored.exit_code, 0) << scored.errors;
}

TEST_F(TeamRun, IsRepeatedToTheSameBytes) {
  ASSERT_EQ(call(folder_, "run world.yaml --quiet --out run").exit_code, 0);
  ASSERT_EQ(call(folder_, "run run/world.yaml --quiet --out again").exit_code, 0);
  expect_same_bytes("run", "again");
}

TEST_F(TeamRun, OfOneRobotIsReplayedToTheSameBits) {
  ASSERT_EQ(call(folder_, "run world.yaml --quiet --out run").exit_code, 0);
  const Called replayed = call(folder_, "replay run/r5 --quiet --out replayed");
  ASSERT_EQ(replayed.exit_code, 0) << replayed.errors;
  EXPECT_EQ(hash_of(folder_ / "replayed"), hash_of(folder_ / "run/r5"));
}

// As if it had been killed: one robot's folder has all, one half a row, one nothing yet.
TEST_F(TeamRun, ThatWasCutOffIsCompletedToTheSameBytes) {
  ASSERT_EQ(call(folder_, "run world.yaml --quiet --out whole").exit_code, 0);
  fs::copy(folder_ / "whole", folder_ / "cut", fs::copy_options::recursive);
  fs::remove(folder_ / "cut/summary.json");
  for (const char* robot : {".", "r1", "r2"}) test::write_file(folder_ / "cut" / robot / "unfinished", "");
  fs::resize_file(folder_ / "cut/r1/odometry.csv", fs::file_size(folder_ / "whole/r1/odometry.csv") / 2);
  fs::remove(folder_ / "cut/r1/summary.json");
  fs::remove(folder_ / "cut/r1/ekf_map.csv");
  fs::remove_all(folder_ / "cut/r3");
  const Called resumed = call(folder_, "run --resume cut --quiet");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
  expect_same_bytes("whole", "cut");
  EXPECT_TRUE(fs::exists(folder_ / "cut/summary.json"));
  EXPECT_EQ(call(folder_, "run --resume cut").output, "cut is complete\n");
}

TEST_F(TeamRun, ThatWasTamperedWithIsNotCompleted) {
  ASSERT_EQ(call(folder_, "run world.yaml --quiet --out run").exit_code, 0);
  test::write_file(folder_ / "run/unfinished", "");
  test::write_file(folder_ / "run/r4/ekf.tum", "0 1 2 3\n");
  const Called resumed = call(folder_, "run --resume run --quiet");
  EXPECT_EQ(resumed.exit_code, 1);
  EXPECT_NE(resumed.errors.find("r4/ekf.tum: did not come again"), std::string::npos) << resumed.errors;
  EXPECT_EQ(read_file(folder_ / "run/r4/ekf.tum"), "0 1 2 3\n");
}

TEST_F(TeamRun, OfAWorldWhoseRobotNamesAnotherEstimator) {
  const Called run = call(folder_,
                          "run world.yaml --json --out run --set 'robots.2.estimators={seif: {}}' --set "
                          "robots.2.drive.pose_from=seif");
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  const nlohmann::json robots = nlohmann::json::parse(run.output).at("robots");
  EXPECT_TRUE(robots.at("r2").at("estimators").contains("seif"));
  EXPECT_FALSE(robots.at("r2").at("estimators").contains("ekf"));
  EXPECT_TRUE(robots.at("r1").at("estimators").contains("ekf"));
  EXPECT_EQ(call(folder_, "replay run/r2 --quiet --out replayed").exit_code, 0);
  EXPECT_EQ(hash_of(folder_ / "replayed"), hash_of(folder_ / "run/r2"));
}

TEST_F(TeamRun, LetsEstimatorsExchangeWhatTheyKnow) {
  const Called run = call(folder_, "run world.yaml --json --out run" + exchanging());
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  const nlohmann::json robots = nlohmann::json::parse(run.output).at("robots");
  int told = 0;
  for (const auto& [name, robot] : robots.items()) {
    const nlohmann::json& exchange = robot.at("exchange").at("multi_seif");
    told += exchange.at("told_pieces").get<int>();
    EXPECT_GT(exchange.at("sent_bytes"), 0) << name;
    EXPECT_LE(exchange.at("learnt_pieces"), exchange.at("heard_pieces")) << name;
    EXPECT_GE(exchange.at("joined_s").size(), 1U) << name;
    EXPECT_FALSE(robot.at("exchange").contains("ekf"));
    EXPECT_LT(robot.at("estimators").at("multi_seif").at("landmark_rmse_aligned_m"), 0.3) << name;
  }
  EXPECT_GT(told, 0);
}

TEST_F(TeamRun, ThatExchangesIsReplayedToTheSameBits) {
  ASSERT_EQ(call(folder_, "run world.yaml --quiet --out run" + exchanging()).exit_code, 0);
  for (const char* robot : {"r0", "r5"}) {
    const std::string folder = std::string("run/") + robot;
    const Called replayed = call(folder_, "replay " + folder + " --quiet --out replayed_" + robot);
    ASSERT_EQ(replayed.exit_code, 0) << replayed.errors;
    EXPECT_EQ(hash_of(folder_ / ("replayed_" + std::string(robot))), hash_of(folder_ / folder)) << robot;
  }
}

TEST_F(TeamRun, IsNotReplayedFromHeardPacketsThatAreNone) {
  ASSERT_EQ(call(folder_, "run world.yaml --quiet --out run" + exchanging()).exit_code, 0);
  for (const char* row : {"0.1,0,8,0,xy", "0.1,0,8,0,0", "0.1,9,8,0,00", "0.1,0,1,0,00", "0.1,0,8,2,00"}) {
    test::write_file(folder_ / "run/r1/multi_seif_heard.csv",
                     std::string("t,robot,robots,more,packet\n") + row + "\n");
    const Called replayed = call(folder_, "replay run/r1 --quiet --out replayed");
    EXPECT_EQ(replayed.exit_code, 2) << row;
    EXPECT_NE(replayed.errors.find("multi_seif_heard.csv:2:"), std::string::npos) << row << replayed.errors;
    fs::remove_all(folder_ / "replayed");
  }
}

TEST_F(TeamRun, ThatExchangesIsCompletedToTheSameBytes) {
  const std::string radio = exchanging() + " --set 'radio={loss: 0.5, cut_off: 0.2, delay_s: 0.3}'";
  ASSERT_EQ(call(folder_, "run world.yaml --quiet --out whole" + radio).exit_code, 0);
  fs::copy(folder_ / "whole", folder_ / "cut", fs::copy_options::recursive);
  fs::remove(folder_ / "cut/summary.json");
  test::write_file(folder_ / "cut/unfinished", "");
  fs::remove_all(folder_ / "cut/r6");
  ASSERT_EQ(call(folder_, "run --resume cut --quiet").exit_code, 0);
  expect_same_bytes("whole", "cut");
}

TEST_F(TeamRun, OfRobotsThatNeverHearEachOtherIsThatOfRobotsAlone) {
  const Called run =
      call(folder_, "run world.yaml --json --out run" + exchanging() + " --set radio.range_m=0");
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  const nlohmann::json robots = nlohmann::json::parse(run.output).at("robots");
  for (const auto& [name, robot] : robots.items())
    EXPECT_TRUE(robot.at("exchange").at("multi_seif").at("joined_s").empty()) << name;
}

TEST_F(TeamRun, ErrorsNameThePlaceInTheRobot) {
  const Called wrong = call(folder_,
                            "run world.yaml --set 'robots.2.estimators={seif: {theta_x: 20, theta_max: 6}}' "
                            "--set robots.2.drive.pose_from=seif");
  EXPECT_EQ(wrong.exit_code, 2) << wrong.errors;
  const Called change = call(folder_,
                             "run world.yaml --set 'faults=[{kind: option, at_s: 1, estimator: seif, option: "
                             "theta_x, new_value: 4}]'");
  EXPECT_EQ(change.exit_code, 2);
  EXPECT_NE(change.errors.find("there is no estimator 'seif'"), std::string::npos) << change.errors;
}

TEST_F(TeamRun, IsRefusedWhereOneRobotIsMeant) {
  ASSERT_EQ(call(folder_, "run world.yaml --quiet --out run").exit_code, 0);
  for (const char* command : {"compare world.yaml --seeds 1", "sweep world.yaml --seeds 1 --out sweep",
                              "live world.yaml", "run world.yaml --film", "run world.yaml --live"}) {
    const Called refused = call(folder_, command);
    EXPECT_EQ(refused.exit_code, 2) << command;
    EXPECT_NE(refused.errors.find("the world has 8 robots"), std::string::npos) << command << refused.errors;
  }
  for (const char* command : {"score run", "film run", "replay run", "report run", "compare run run",
                              "live run", "export run --format tum --out there"}) {
    const Called refused = call(folder_, command);
    EXPECT_EQ(refused.exit_code, 2) << command;
    EXPECT_NE(refused.errors.find("is the folder of 8 robots; name the folder of one of them"),
              std::string::npos)
        << command << '\n'
        << refused.errors;
  }
}

}  // namespace
}  // namespace harness
