// The file of a takeover: who has the wheel, and since when.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "world_files.hpp"
#include "worlds/commands.hpp"

namespace worlds {
namespace {

using test::Folder;
using test::load_text;
using test::text_of;

constexpr const char* wheel_world = "drive: {mode: hold, takeover_file: hands/wheel.csv}\n";

/// The problems of a file of a takeover with this text, without its path.
std::string problems_of_wheel(std::string_view text) {
  const Folder folder;
  const std::string path = folder.write("hands/wheel.csv", text).string();
  std::string problems = text_of(load_text(folder, wheel_world).problems);
  for (std::size_t at = 0; (at = problems.find(path, at)) != std::string::npos;)
    problems.erase(at, path.size());
  return problems;
}

TEST(Takeover, IsReadInAnyModeWithItsReleases) {
  const Folder folder;
  folder.write("hands/wheel.csv", "t,v,omega\n0.5,0.25,-0.1\r\n12.5,,\n13,-1e-3,0\n");
  for (const char* mode : {"hold", "explore", "loop, waypoints_m: [[1, 0], [1, 1], [0, 1]]"}) {
    const LoadResult result =
        load_text(folder, "drive: {mode: " + std::string(mode) + ", takeover_file: hands/wheel.csv}\n");
    ASSERT_TRUE(result.world) << text_of(result.problems);
    const std::vector<Takeover>& rows = result.world->drive.takeover;
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].t, 0.5);
    EXPECT_FALSE(rows[0].released);
    EXPECT_EQ(rows[0].v, 0.25);
    EXPECT_EQ(rows[0].omega, -0.1);
    EXPECT_EQ(rows[1].t, 12.5);
    EXPECT_TRUE(rows[1].released);
    EXPECT_FALSE(rows[2].released);
    EXPECT_EQ(rows[2].v, -1e-3);
  }
}

TEST(Takeover, IsNoneWithoutAFile) {
  const Folder folder;
  const LoadResult result = load_text(folder, "{}");
  ASSERT_TRUE(result.world);
  EXPECT_TRUE(result.world->drive.takeover.empty());
  EXPECT_TRUE(result.world->drive.takeover_file.empty());
}

TEST(Takeover, HasItsFullPathInTheResolvedWorld) {
  const Folder folder;
  const auto file = folder.write("hands/wheel.csv", "t,v,omega\n1,,\n");
  const LoadResult first = load_text(folder, wheel_world);
  ASSERT_TRUE(first.world) << text_of(first.problems);
  EXPECT_EQ(first.world->drive.takeover_file, std::filesystem::canonical(file).string());
  const Folder elsewhere;
  const LoadResult again = load_text(elsewhere, first.resolved);
  ASSERT_TRUE(again.world) << text_of(again.problems);
  EXPECT_EQ(again.world->drive.takeover.size(), 1U);
}

// With the digits that are written for a double, the same double is read.
TEST(Takeover, KeepsEveryBitOfItsNumbers) {
  const Folder folder;
  folder.write("hands/wheel.csv",
               "t,v,omega\n0.1,0.30000000000000004,-0.1\n0.30000000000000004,1e-300,3.3333333333333335\n");
  const LoadResult result = load_text(folder, wheel_world);
  ASSERT_TRUE(result.world) << text_of(result.problems);
  const std::vector<Takeover>& rows = result.world->drive.takeover;
  EXPECT_EQ(rows[0].v, 0.1 + 0.2);
  EXPECT_EQ(rows[1].t, 0.1 + 0.2);
  EXPECT_EQ(rows[1].v, 1e-300);
  EXPECT_EQ(rows[1].omega, 10.0 / 3.0);
}

TEST(Takeover, WithAMistakeIsRefusedWithTheLine) {
  EXPECT_EQ(problems_of_wheel("t,v,omega\n0,1,0\n0,1,0\n"),
            ":3:1: the time must be at least 0 and more than in the row before, not 0\n");
  EXPECT_EQ(problems_of_wheel("t,v,omega\n1,,\n1,,\n"),
            ":3:1: the time must be at least 0 and more than in the row before, not 1\n");
  EXPECT_EQ(problems_of_wheel("t,v,omega\n1,0.5,\n"),
            ":2:1: 'omega' must be a number of at most 1000000, not ''\n");
  EXPECT_EQ(problems_of_wheel("t,v,omega\n1,,0.5\n"),
            ":2:1: 'v' must be a number of at most 1000000, not ''\n");
  EXPECT_EQ(problems_of_wheel("t,v,omega\n,,\n"), ":2:1: 't' must be a number of at most 1000000, not ''\n");
  EXPECT_EQ(problems_of_wheel("t,v,omega\n1,nan,0\n2,1\n"),
            ":2:1: 'v' must be a number of at most 1000000, not 'nan'\n"
            ":3:1: expected three numbers: t,v,omega\n");
  EXPECT_EQ(problems_of_wheel("t,v\n1,2\n"), ":1:1: the first line must be the head t,v,omega\n");
  EXPECT_NE(problems_of_wheel("t,v,omega\n").find("there are no commands in the file"), std::string::npos);
}

TEST(Takeover, ThatIsMissingIsToldWhereItIsNamed) {
  const Folder folder;
  const std::string problems = text_of(load_text(folder, wheel_world).problems);
  EXPECT_NE(problems.find("world.yaml:1:36: "), std::string::npos) << problems;
}

TEST(Commands, CannotGiveTheWheelBack) {
  const Folder folder;
  std::vector<Problem> problems;
  read_commands(folder.write("moves.csv", "t,v,omega\n1,,\n"), problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems.front().where.line, 2);
}

}  // namespace
}  // namespace worlds
