#include "harness/figures/piped_program.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <system_error>
#include <vector>

#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::read_file;

const std::vector<std::uint8_t> megabyte(1'000'000, 'x');

TEST(PipedProgram, GetsEveryByte) {
  const TemporaryFolder folder;
  PipedProgram program({"sh", "-c", "cat > \"$0\"", folder / "bytes"});
  EXPECT_TRUE(program.send(megabyte));
  EXPECT_TRUE(program.send({}));
  EXPECT_TRUE(program.send(megabyte));
  EXPECT_TRUE(program.finish());
  EXPECT_TRUE(program.finish()) << "a second time";
  EXPECT_EQ(program.complaint(), "");
  EXPECT_EQ(read_file(folder / "bytes"), std::string(2 * megabyte.size(), 'x'));
}

TEST(PipedProgram, IsWaitedForWithoutFinish) {
  const TemporaryFolder folder;
  {
    PipedProgram program({"sh", "-c", "cat > /dev/null; sleep 0.2; echo done > \"$0\"", folder / "end"});
    EXPECT_TRUE(program.send(megabyte));
  }
  EXPECT_EQ(read_file(folder / "end"), "done\n");
}

TEST(PipedProgram, TellsThatItFailedAndWhy) {
  PipedProgram program({"sh", "-c", "cat > /dev/null; echo no more >&2; exit 3"});
  EXPECT_TRUE(program.send(megabyte));
  EXPECT_FALSE(program.finish());
  EXPECT_FALSE(program.finish()) << "a second time";
  EXPECT_EQ(program.complaint(), "no more\n");
}

TEST(PipedProgram, FailsIfItIsKilled) {
  PipedProgram program({"sh", "-c", "kill -9 $$"});
  EXPECT_FALSE(program.finish());
}

TEST(PipedProgram, MayEndBeforeItsInput) {
  PipedProgram program({"sh", "-c", "head -c 1000 > /dev/null"});
  EXPECT_FALSE(program.send(megabyte)) << "and SIGPIPE has not ended this test";
  EXPECT_TRUE(program.finish());
}

TEST(PipedProgram, MaySayMoreThanAnyoneWantsToHear) {
  PipedProgram program({"sh", "-c", "head -c 1000000 /dev/zero | tr '\\0' e >&2; cat > /dev/null"});
  EXPECT_TRUE(program.send(megabyte)) << "and neither waits for the other";
  EXPECT_TRUE(program.finish());
  EXPECT_EQ(program.complaint(), std::string(4096, 'e'));
}

TEST(PipedProgram, PrintsNothingOnOurOutput) {
  testing::internal::CaptureStdout();
  {
    PipedProgram program({"echo", "hello"});
    EXPECT_TRUE(program.finish());
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(PipedProgram, MustBeThere) {
  try {
    const PipedProgram program({"no-such-program"});
    FAIL() << "started";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
    EXPECT_NE(std::string(error.what()).find("no-such-program"), std::string::npos);
  }
}

}  // namespace
}  // namespace harness
