#include "harness/recording/run_folder.hpp"

#include <gtest/gtest.h>

#include <string>

#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::write_file;

TEST(RunFolder, IsNeverUsedTwice) {
  const TemporaryFolder folder;
  EXPECT_EQ(create_run_folder(folder / "runs", "a-1"), folder / "runs" / "a-1");
  EXPECT_EQ(create_run_folder(folder / "runs", "a-1"), folder / "runs" / "a-1-2");
  EXPECT_EQ(create_run_folder(folder / "runs", "a-1"), folder / "runs" / "a-1-3");
}

TEST(RunFolder, OneThatHoldsSomethingIsRefused) {
  const TemporaryFolder folder;
  EXPECT_EQ(create_empty_folder(folder / "new"), folder / "new");
  EXPECT_EQ(create_empty_folder(folder / "new"), folder / "new");
  write_file(folder / "new" / "precious", "");
  EXPECT_THROW(create_empty_folder(folder / "new"), BadInput);
  EXPECT_THROW(create_empty_folder(folder / "new" / "precious"), BadInput);
}

TEST(RunFolder, NamesCannotLeaveTheFolder) {
  EXPECT_EQ(file_name_of("../../etc"), "_.._.._etc");
  EXPECT_EQ(file_name_of(".."), "_..");
  EXPECT_EQ(file_name_of(""), "_");
  EXPECT_EQ(file_name_of("report2002_a-b.c"), "report2002_a-b.c");
  EXPECT_LT(file_name_of(std::string(100000, 'a')).size(), 200U);
}

TEST(TrajectoryHash, DependsOnTheNamedFilesAlone) {
  const TemporaryFolder folder;
  write_file(folder / "truth.csv", "t\n");
  write_file(folder / "ekf.tum", "0 0\n");
  const std::string hash = trajectory_hash(folder.path());
  EXPECT_EQ(hash.size(), 16U);
  write_file(folder / "ekf_times.csv", "1\n");
  write_file(folder / "summary.json", "{}\n");
  EXPECT_EQ(trajectory_hash(folder.path()), hash);
  write_file(folder / "ekf.tum", "0 1\n");
  EXPECT_NE(trajectory_hash(folder.path()), hash);
}

}  // namespace
}  // namespace harness
