#include <gtest/gtest.h>
#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/csv_reader.hpp"
#include "harness/files/csv_writer.hpp"
#include "harness/files/output_file.hpp"
#include "harness/fixtures.hpp"
#include "harness/score/summary.hpp"

namespace harness {
namespace {

using test::write_file;

TEST(Csv, NumbersComeBackBitForBit) {
  const TemporaryFolder folder;
  std::vector<double> numbers = {0.0,
                                 -0.0,
                                 0.1,
                                 1.0 / 3.0,
                                 1e300,
                                 -1e-300,
                                 std::numeric_limits<double>::denorm_min(),
                                 std::numeric_limits<double>::max(),
                                 std::nextafter(1.0, 2.0)};
  std::mt19937_64 random(1);
  while (numbers.size() < 5000) {
    const double number = std::bit_cast<double>(random());
    if (std::isfinite(number)) numbers.push_back(number);
  }
  CsvWriter writer(folder / "a.csv", "number");
  for (const double number : numbers) writer.value(number).end_row();
  writer.close();
  CsvReader reader(folder / "a.csv", {{"number"}, {}});
  for (const double number : numbers) {
    ASSERT_TRUE(reader.next());
    EXPECT_EQ(std::bit_cast<std::uint64_t>(reader.number(0)), std::bit_cast<std::uint64_t>(number));
  }
  EXPECT_FALSE(reader.next());
}

TEST(Csv, ReadsWindowsLineEndsAndAByteOrderMark) {
  const TemporaryFolder folder;
  write_file(folder / "a.csv",
             "\xEF\xBB\xBF"
             "a, b\r\n1, 2\r\n3,4\r\n");
  CsvReader reader(folder / "a.csv", {{"a", "b"}, {}});
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.number(1), 2.0);
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.number(1), 4.0);
  EXPECT_FALSE(reader.next());
}

TEST(Csv, ALastLineWithoutEndIsRefusedSinceTheFileMayBeCut) {
  const TemporaryFolder folder;
  write_file(folder / "a.csv", "a,b\n1,2\n3,4e-0");
  CsvReader reader(folder / "a.csv", {{"a", "b"}, {}});
  ASSERT_TRUE(reader.next());
  try {
    reader.next();
    FAIL() << "it was taken";
  } catch (const BadInput& error) {
    EXPECT_EQ(error.what(),
              (folder / "a.csv").string() + ":3:7: the last line has no line end: the file may be cut");
  }
  write_file(folder / "head.csv", "a,b");
  EXPECT_THROW(CsvReader(folder / "head.csv", {{"a", "b"}, {}}), BadInput);
}

TEST(Csv, ColumnsOfNewerVersionsMayBeMissing) {
  const TemporaryFolder folder;
  const Columns columns{{"t"}, {"gated"}, {"innovation", "degrees"}};
  write_file(folder / "oldest.csv", "t\n1\n");
  write_file(folder / "old.csv", "t,gated\n1,2\n");
  write_file(folder / "new.csv", "t,gated,innovation,degrees\n1,2,3.5,4\n");
  write_file(folder / "odd.csv", "t,innovation,degrees\n1,3.5,4\n");
  EXPECT_FALSE(CsvReader(folder / "oldest.csv", columns).has_optional());
  CsvReader old(folder / "old.csv", columns);
  EXPECT_TRUE(old.has_optional());
  EXPECT_FALSE(old.has_newer());
  CsvReader newest(folder / "new.csv", columns);
  EXPECT_TRUE(newest.has_optional());
  EXPECT_TRUE(newest.has_newer());
  ASSERT_TRUE(newest.next());
  EXPECT_EQ(newest.number(2), 3.5);
  EXPECT_EQ(newest.integer(3, 0, 9), 4);
  EXPECT_THROW(CsvReader(folder / "odd.csv", columns), BadInput);
}

TEST(Csv, ALineWithoutEndUsesNoMemory) {
  const TemporaryFolder folder;
  write_file(folder / "a.csv", "a\n" + std::string(1 << 20, '1'));
  CsvReader reader(folder / "a.csv", {{"a"}, {}});
  EXPECT_THROW(reader.next(), BadInput);
}

TEST(Csv, WhatIsNoRegularFileIsRefusedAndNotWaitedFor) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder / "zeros");
  std::filesystem::create_directory(folder / "folder");
  for (const char* name : {"pipe", "zeros", "folder", "nothing"}) {
    EXPECT_THROW(CsvReader(folder / name, {{"a"}, {}}), BadInput) << name;
    EXPECT_THROW(read_whole_file(folder / name), BadInput) << name;
    EXPECT_THROW(read_summary(folder / name), BadInput) << name;
  }
}

TEST(Csv, NeverWritesOverAFile) {
  const TemporaryFolder folder;
  write_file(folder / "a.csv", "precious");
  EXPECT_THROW(CsvWriter(folder / "a.csv", "a"), std::system_error);
  EXPECT_EQ(test::read_file(folder / "a.csv"), "precious");
}

TEST(Csv, AFileThatWasDeletedMeanwhileIsAnError) {
  const TemporaryFolder folder;
  CsvWriter writer(folder / "a.csv", "a");
  std::filesystem::remove(folder / "a.csv");
  EXPECT_THROW(writer.close(), std::system_error);
}

}  // namespace
}  // namespace harness
