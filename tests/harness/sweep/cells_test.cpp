#include "harness/sweep/cells.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/recording/run_folder.hpp"

namespace harness {
namespace {

using States = std::vector<CellState>;

TEST(CellFolder, AResultTakesThePlaceOfAFailure) {
  const TemporaryFolder folder;
  const CellFolder cells(folder.path());
  cells.put_failure(1, "gave up");
  cells.put_result(2, "two");
  EXPECT_EQ(cells.states(4), (States{CellState::open, CellState::failed, CellState::done, CellState::open}));
  EXPECT_EQ(cells.failure(1), "gave up");
  cells.put_result(1, "one");
  EXPECT_EQ(cells.states(3), (States{CellState::open, CellState::done, CellState::done}));
  EXPECT_EQ(cells.result(1), "one");
}

TEST(CellFolder, WhatIsNoCellOfTheSweepIsNone) {
  const TemporaryFolder folder;
  for (const char* name : {"000001.json.host-7.unfinished", "x1.json", "9.json", "0.txt"})
    test::write_file(folder / name, "half of it");
  EXPECT_EQ(CellFolder(folder.path()).states(2), (States{CellState::open, CellState::open}));
  remove_unfinished_files(folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder / "000001.json.host-7.unfinished"));
  EXPECT_TRUE(std::filesystem::exists(folder / "x1.json"));
}

TEST(DurableFile, HasItsNameWhenItIsCommittedAndNotBefore) {
  const TemporaryFolder folder;
  test::write_file(folder / "table.csv", "old");
  {
    DurableFile file(folder / "table.csv");
    file.append("new");
    EXPECT_EQ(test::read_file(folder / "table.csv"), "old");
    file.commit();
  }
  EXPECT_EQ(test::read_file(folder / "table.csv"), "new");
}

/// Writers of the same file are killed in the middle of it, many times.
TEST(DurableFile, IsWholeWhoeverIsKilled) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "0.json";
  const std::set<std::string> whole = {std::string(300'000, 'a'), std::string(500'000, 'b')};
  int found = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<pid_t> writers;
    for (const std::string& text : whole) {
      const pid_t writer = fork();
      if (writer == 0) {
        while (true) write_durable_file(path, text);
      }
      writers.push_back(writer);
    }
    usleep(3'000 + 700U * static_cast<unsigned>(round));
    for (const pid_t writer : writers) {
      kill(writer, SIGKILL);
      waitpid(writer, nullptr, 0);
    }
    if (!std::filesystem::exists(path)) continue;
    ++found;
    EXPECT_TRUE(whole.contains(read_whole_file(path))) << read_whole_file(path).size();
  }
  EXPECT_GT(found, 0);
}

}  // namespace
}  // namespace harness
