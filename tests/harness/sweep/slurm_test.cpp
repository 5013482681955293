#include "harness/sweep/slurm.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"
#include "harness/sweep/shell.hpp"

namespace harness {
namespace {

using test::call_program;
using test::Called;
using test::read_file;

TEST(SlurmQueue, CountsTheTasksOfItsOwnSweep) {
  const SlurmQueue queue = parse_slurm_queue(
      "seifbed-a-8|12|3|RUNNING\n"
      "seifbed-a-8|12|4|PENDING\n"
      "seifbed-a-8|12|6|COMPLETING\n"
      "seifbed-a-8|14|1|PENDING\n"
      "seifbed-a-merge|13|N/A|PENDING\n"
      "seifbed-b-8|15|2|RUNNING\n"
      "other job|16|1|RUNNING\n",
      "seifbed-a-");
  EXPECT_EQ(queue.running, 1U);
  EXPECT_EQ(queue.pending, 2U);
  EXPECT_EQ(queue.tasks, 8U);
  EXPECT_EQ(queue.shards, (std::set<std::size_t>{1, 3, 4}));
  EXPECT_EQ(queue.arrays, (std::set<std::string>{"12", "14"}));
  EXPECT_EQ(queue.merges, (std::set<std::string>{"13"}));
  EXPECT_FALSE(parse_slurm_queue("", "seifbed-a-").tasks);
}

TEST(Shell, WordsComeThroughAsTheyAre) {
  const std::string word = "it's \"$HOME\" `x` \\ *\n";
  EXPECT_EQ(output_of({"printf", "%s", word}), word);
  EXPECT_THROW(output_of({"false"}), std::runtime_error);
  try {
    output_of({"seifbed-no-such-program"});
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "there is no program seifbed-no-such-program here");
  }
}

/// A Slurm cluster of one node that exists during one test.
class SlurmTest : public testing::Test {
 protected:
  void SetUp() override {
    if (call_program(folder, "PATH=$PATH:/usr/sbin; type munged slurmctld slurmd").exit_code != 0)
      GTEST_SKIP() << "there is no Slurm here: apt-get install munge slurm-wlm";
    if (geteuid() != 0) GTEST_SKIP() << "a Slurm of one's own needs root";
    std::filesystem::create_directories(folder / "private");
    const Called called = call_program(folder, script + "start private");
    started = called.exit_code == 0;
    ASSERT_TRUE(started) << called.errors;
    // When a test takes too long it is killed, and this watcher then removes the daemons.
    call_program(folder, "(setsid " + script + "watch private " + std::to_string(getpid()) +
                             " >private/watch.log 2>&1 </dev/null &)");
    test::write_file(folder / "world.yaml",
                     "name: small\n"
                     "duration_s: 60\n"
                     "landmarks: {generators: [{type: uniform, count: 20}]}\n"
                     "drive: {mode: loop, waypoints_m: [[3, 3], [-3, 3], [-3, -3], [3, -3]]}\n"
                     "estimators: {ekf: {}, seif_report: {}}\n");
  }

  ~SlurmTest() override {
    if (started) call_program(folder, script + "stop private");
  }

  Called call(const std::string& arguments) const {
    return test::call(folder, arguments, "SLURM_CONF=$PWD/private/slurm.conf");
  }

  Called slurm(const std::string& line) const {
    return call_program(folder, "SLURM_CONF=$PWD/private/slurm.conf " + line);
  }

  /// Expects the same bytes as from a sweep without Slurm.
  void expect_whole() const {
    EXPECT_EQ(call("sweep world.yaml --seeds 1..6 --jobs 2 --out here --quiet").exit_code, 0);
    for (const char* name : {"runs.csv", "aggregate.csv", "aggregate.json"}) {
      EXPECT_FALSE(read_file(folder / "here" / name).empty());
      EXPECT_EQ(read_file(folder / "there" / name), read_file(folder / "here" / name));
    }
  }

  static bool wait_until(const std::function<bool()>& is_so) {
    for (int i = 0; i < 4800; ++i) {
      if (is_so()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  bool wait_for_empty_queue() const {
    return wait_until([this] { return slurm("squeue --noheader").output.empty(); });
  }

  const TemporaryFolder folder;
  const std::string script = SEIFBED_SOURCE_DIR "/tests/harness/sweep/private_slurm.sh ";
  const std::string submit_line = "sweep world.yaml --seeds 1..6 --out there --slurm --array 3";
  bool started = false;
};

TEST_F(SlurmTest, AnArrayGivesTheBytesOfTwoJobs) {
  const Called submitted = call(submit_line);
  EXPECT_EQ(submitted.exit_code, 0) << submitted.errors;
  EXPECT_NE(submitted.output.find("submitted 3 of 3 tasks as job 1, and job 2 to merge"), std::string::npos)
      << submitted.output;
  EXPECT_NE(call("sweep --status there").output.find("Slurm: "), std::string::npos);
  ASSERT_TRUE(wait_for_empty_queue());
  EXPECT_EQ(call("sweep --status there").output, "small: 6 of 6 runs done, 0 failed, 0 open\n");
  expect_whole();
}

TEST_F(SlurmTest, ATaskThatIsKilledIsSubmittedAgainByTheSameCall) {
  EXPECT_EQ(call(submit_line).exit_code, 0);
  const Called again = call(submit_line);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.output.find("nothing to submit"), std::string::npos) << again.output;
  const Called differently = call("sweep --resume there --slurm --array 4");
  EXPECT_EQ(differently.exit_code, 2);
  EXPECT_NE(differently.errors.find("divide the sweep by 3, and not by 4"), std::string::npos)
      << differently.errors;

  // The second task runs cells 1 and 4: it dies in the middle of cell 4.
  ASSERT_TRUE(
      wait_until([&] { return std::filesystem::exists(folder / "there" / "cells" / "000001.json"); }));
  EXPECT_EQ(slurm("scancel --signal=KILL 1_2").exit_code, 0);
  ASSERT_TRUE(wait_for_empty_queue());
  EXPECT_FALSE(std::filesystem::exists(folder / "there" / "aggregate.json"));
  const Called status = call("sweep --status there");
  EXPECT_NE(status.output.find("Slurm: 0 tasks running, 0 pending"), std::string::npos) << status.output;

  const Called resumed = call(submit_line);
  EXPECT_NE(resumed.output.find("submitted 1 of 3 tasks"), std::string::npos) << resumed.output;
  ASSERT_TRUE(wait_for_empty_queue());
  expect_whole();
}

TEST_F(SlurmTest, WhatSbatchRefusesIsAnError) {
  const Called called = call(submit_line + " --sbatch=--partition=nowhere");
  EXPECT_EQ(called.exit_code, 1);
  EXPECT_NE(called.errors.find("sbatch failed"), std::string::npos) << called.errors;
}

}  // namespace
}  // namespace harness
