#include "harness/files/output_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "harness/command_call.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

/// A file, and what no output may replace: a pipe, a folder, and links to a file, to a folder and to nothing.
class Output : public testing::Test {
 protected:
  Output() {
    test::write_file(folder / "file", "old");
    ::mkfifo((folder / "pipe").c_str(), 0600);
    std::filesystem::create_directory(folder / "folder");
    std::filesystem::create_symlink("file", folder / "link");
    std::filesystem::create_symlink("folder", folder / "link_to_folder");
    std::filesystem::create_symlink("nothing", folder / "loose_link");
  }

  /// The kinds of all files, and the text of `file`.
  std::string state() const {
    std::string text = test::read_file(folder / "file");
    for (const char* name : never)
      text += fmt::format(" {}", static_cast<int>(std::filesystem::symlink_status(folder / name).type()));
    return text;
  }

  static constexpr const char* never[] = {"pipe", "folder", "link", "link_to_folder", "loose_link"};
  TemporaryFolder folder;
};

TEST_F(Output, NeverReplacesWhatIsNoRegularFile) {
  const std::string before = state();
  for (const char* name : never) {
    for (const Existing existing : {Existing::keep, Existing::replace}) {
      EXPECT_THROW(check_output(folder / name, existing), BadInput) << name;
      EXPECT_THROW(write_whole_file(folder / name, "new", existing), BadInput) << name;
      test::write_file(folder / "unfinished", "new");
      EXPECT_THROW(rename_output(folder / "unfinished", folder / name, existing), BadInput) << name;
    }
  }
  EXPECT_THROW(check_output("/dev/null", Existing::replace), BadInput);
  EXPECT_EQ(state(), before);
}

TEST_F(Output, KeepsAFileUnlessItMayBeReplaced) {
  EXPECT_THROW(write_whole_file(folder / "file", "new", Existing::keep), BadInput);
  test::write_file(folder / "unfinished", "new");
  EXPECT_THROW(rename_output(folder / "unfinished", folder / "file", Existing::keep), BadInput);
  EXPECT_EQ(test::read_file(folder / "file"), "old");
  write_whole_file(folder / "file", "new", Existing::replace);
  EXPECT_EQ(test::read_file(folder / "file"), "new");
  write_whole_file(folder / "another", "first", Existing::keep);
  EXPECT_EQ(test::read_file(folder / "another"), "first");
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_NE(entry.path().extension(), ".part");
}

TEST_F(Output, OfEveryCommandFollowsThisRule) {
  test::write_file(folder / "world.yaml",
                   "name: small\nduration_s: 2\nphysics: {engine: kinematic}\n"
                   "landmarks: {generators: [{type: uniform, count: 5}]}\nestimators: {ekf: {}}\n");
  ASSERT_EQ(test::call(folder, "run world.yaml --out run --quiet").exit_code, 0);
  const std::string before = state();
  for (const std::string command : {"report run --no-replay --out ", "export run --format tum --out "}) {
    for (const std::string name : never) {
      const test::Called called = test::call(folder, command + name + " --force");
      EXPECT_EQ(called.exit_code, 2) << command + name;
      EXPECT_TRUE(called.errors.starts_with(name + ": is ")) << called.errors;
    }
    const test::Called kept = test::call(folder, command + "file");
    EXPECT_EQ(kept.exit_code, 2);
    EXPECT_EQ(kept.errors, "file: is there already; --force replaces it\n");
    EXPECT_EQ(state(), before);
    EXPECT_EQ(test::call(folder, command + "file --force").exit_code, 0);
    EXPECT_NE(test::read_file(folder / "file"), "old");
    test::write_file(folder / "file", "old");
  }
  for (const std::string command :
       {"run world.yaml", "replay run", "paper --runs 1", "stress --landmarks 100"}) {
    for (const std::string name : {"file", "pipe", "link", "loose_link"})
      EXPECT_EQ(test::call(folder, command + " --quiet --out " + name).exit_code, 2) << command + ' ' + name;
  }
  EXPECT_EQ(state(), before);
}

TEST_F(Output, OfAFilmFollowsThisRule) {
  test::write_file(folder / "world.yaml",
                   "name: small\nduration_s: 2\nphysics: {engine: kinematic}\n"
                   "landmarks: {generators: [{type: uniform, count: 5}]}\nestimators: {ekf: {}}\n");
  ASSERT_EQ(test::call(folder, "run world.yaml --out run --quiet").exit_code, 0);
  test::write_file(folder / "old.png", "old");
  test::write_file(folder / "many_00000.png", "old");
  std::filesystem::create_symlink("old.png", folder / "link.png");
  EXPECT_EQ(test::call(folder, "film run --at 1 -o old.png").exit_code, 2);
  EXPECT_EQ(test::call(folder, "film run -o many.png").exit_code, 2);
  EXPECT_EQ(test::call(folder, "film run --at 1 --force -o link.png").exit_code, 2);
  EXPECT_EQ(test::read_file(folder / "old.png"), "old");
  EXPECT_EQ(test::call(folder, "film run --at 1 --size 320x180 --force -o old.png").exit_code, 0);
  EXPECT_TRUE(test::read_file(folder / "old.png").starts_with("\x89PNG"));
}

TEST_F(Output, OfAReportAtItsUsualPlaceIsMadeAgain) {
  test::write_file(folder / "world.yaml",
                   "name: small\nduration_s: 2\nphysics: {engine: kinematic}\n"
                   "landmarks: {generators: [{type: uniform, count: 5}]}\nestimators: {ekf: {}}\n");
  ASSERT_EQ(test::call(folder, "run world.yaml --out run --quiet").exit_code, 0);
  for (const char* again : {"report run --no-replay", "report run --no-replay --out run/../run/report.html"})
    EXPECT_EQ(test::call(folder, again).exit_code, 0) << again;
  std::filesystem::remove(folder / "run/report.html");
  std::filesystem::create_symlink("../file", folder / "run/report.html");
  EXPECT_EQ(test::call(folder, "report run --no-replay").exit_code, 2);
  EXPECT_EQ(test::read_file(folder / "file"), "old");
  std::filesystem::create_directory(folder / "figures");
  std::filesystem::create_symlink("../file", folder / "figures/map.svg");
  EXPECT_EQ(test::call(folder, "report run --no-replay --out page.html --figures figures").exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "page.html"));
  EXPECT_EQ(test::read_file(folder / "file"), "old");
}

}  // namespace
}  // namespace harness
