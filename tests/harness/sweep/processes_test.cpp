#include "harness/sweep/processes.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/terminal/interrupt.hpp"

namespace harness {
namespace {

const std::atomic<bool> never = false;

std::map<std::size_t, std::string> ends_of(const std::vector<std::size_t>& jobs, int at_once,
                                           const std::function<int(std::size_t)>& run) {
  std::map<std::size_t, std::string> ends;
  run_in_processes(jobs, at_once, never, run,
                   [&](std::size_t job, const ProcessEnd& end) { ends[job] = to_string(end); });
  return ends;
}

TEST(RunInProcesses, TheEndOfOneTakesNoOtherDown) {
  const auto run = [](std::size_t job) {
    if (job == 3) std::raise(SIGKILL);
    if (job == 5) throw std::runtime_error("nobody catches this");
    return job == 4 ? 17 : 0;
  };
  for (const int at_once : {1, 3, 100}) {
    const std::map<std::size_t, std::string> ends = ends_of({2, 3, 4, 5, 6}, at_once, run);
    ASSERT_EQ(ends.size(), 5U);
    EXPECT_EQ(ends.at(2), "ended with exit code 0");
    EXPECT_EQ(ends.at(3), "ended by signal 9 (Killed)");
    EXPECT_EQ(ends.at(4), "ended with exit code 17");
    EXPECT_EQ(ends.at(5), "ended with exit code 1");
    EXPECT_EQ(ends.at(6), "ended with exit code 0");
  }
}

TEST(RunInProcesses, KnowsHowAChildEndedAlsoWhereThatSignalWasIgnored) {
  std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(ends_of({1}, 1, [](std::size_t) { return 4; }).at(1), "ended with exit code 4");
  std::signal(SIGCHLD, SIG_DFL);
}

TEST(RunInProcesses, StopEndsThoseThatRunAndBeginsNoMore) {
  const InterruptGuard guard;
  std::size_t begun = 0;
  const std::vector<std::size_t> jobs = {1, 2, 3, 4};
  run_in_processes(
      jobs, 2, InterruptGuard::flag(),
      [](std::size_t job) {
        if (job == 1) kill(getppid(), SIGINT);
        while (!InterruptGuard::flag()) usleep(1'000);
        return 130;
      },
      [&](std::size_t, const ProcessEnd& end) {
        ++begun;
        EXPECT_EQ(end.exit_code, 130);
      });
  EXPECT_LE(begun, 2U);
  EXPECT_GE(begun, 1U);
}

TEST(RunInProcesses, ChildrenEndWithTheirParentHoweverThatEnds) {
  const TemporaryFolder folder;
  const pid_t parent = fork();
  if (parent == 0) {
    const std::vector<std::size_t> jobs = {0, 1};
    run_in_processes(
        jobs, 2, never,
        [&](std::size_t job) {
          const InterruptGuard guard;
          test::write_file(folder / ("begun" + std::to_string(job)), "");
          while (!InterruptGuard::flag()) usleep(1'000);
          test::write_file(folder / ("ended" + std::to_string(job)), "");
          return 0;
        },
        [](std::size_t, const ProcessEnd&) {});
    _exit(0);
  }
  const auto wait_for = [&](const char* name) {
    for (int i = 0; i < 10'000 && !std::filesystem::exists(folder / name); ++i) usleep(1'000);
    return std::filesystem::exists(folder / name);
  };
  ASSERT_TRUE(wait_for("begun0") && wait_for("begun1"));
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  EXPECT_TRUE(wait_for("ended0") && wait_for("ended1"));
}

}  // namespace
}  // namespace harness
