// No input file can choose where something is written, or what is executed.
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"
#include "harness/sweep/shell.hpp"

namespace harness {
namespace {

namespace fs = std::filesystem;
using test::call;
using test::Called;

constexpr const char* world =
    "duration_s: 3\n"
    "landmarks: {generators: [{type: uniform, count: 20}]}\n"
    "estimators: {ekf: {}}\n";

TEST(Paths, TheNameOfAWorldOrLogStaysInTheFolderOfRuns) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "inner");
  test::write_file(folder / "inner" / "world.yaml", std::string("name: ../../../evil\n") + world);
  const std::string in_inner = "cd inner;";
  ASSERT_EQ(call(folder, "run world.yaml --quiet", in_inner).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "inner" / "runs" / "_.._.._.._evil-1" / "summary.json"));
  ASSERT_EQ(call(folder, "replay runs/_.._.._.._evil-1 --quiet", in_inner).exit_code, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "inner" / "runs"), {}), 2);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(Paths, NamesOfEstimatorsCannotLeaveTheRun) {
  const TemporaryFolder folder;
  test::write_file(folder / "world.yaml", std::string("name: w\n") + world);
  const Called run = call(folder, "run world.yaml --set 'estimators={../ekf: {type: ekf}}' --out run");
  EXPECT_EQ(run.exit_code, 2);
  ASSERT_EQ(call(folder, "run world.yaml --quiet --out run").exit_code, 0);
  std::string summary = test::read_file(folder / "run" / "summary.json");
  const std::string name = "\"ekf\"";
  summary.replace(summary.rfind(name), name.size(), "\"../ekf\"");
  test::write_file(folder / "run" / "summary.json", summary);
  const Called score = call(folder, "score run");
  EXPECT_EQ(score.exit_code, 2);
  EXPECT_NE(score.errors.find("'../ekf' is no name of an estimator"), std::string::npos) << score.errors;
}

TEST(Paths, AWorldThatExtendsWhatIsNoWorldIsRefused) {
  const TemporaryFolder folder;
  test::write_file(folder / "world.yaml", "extends: /etc/passwd\n");
  const Called run = call(folder, "validate world.yaml");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.errors.find("root"), std::string::npos) << "what stands in that file is nobody's business";
}

TEST(Paths, NoMessageQuotesAFileThatIsNoWorld) {
  const TemporaryFolder folder;
  test::write_file(folder / "shadow", "root:secret:19000:7:::\nmail:secret:19000:7:::\n");
  fs::create_symlink("shadow", folder / "link.yaml");
  test::write_file(folder / "plain.yaml", "root:secret:19000:7\nmail:secret:19000:7\n");
  for (const char* text : {"extends: shadow", "extends: link.yaml", "extends: plain.yaml",
                           "drive: {mode: commands, file: shadow}"}) {
    test::write_file(folder / "world.yaml", std::string(text) + "\n");
    const Called run = call(folder, "validate world.yaml");
    EXPECT_EQ(run.exit_code, 2) << text;
    EXPECT_FALSE(run.errors.empty()) << text;
    EXPECT_EQ(run.errors.find("secret"), std::string::npos) << run.errors;
  }
}

TEST(Paths, NothingInANameIsExecuted) {
  const TemporaryFolder folder;
  const std::string name = "$(touch a)`touch b`;touch c;'touch d'&|.yaml";
  test::write_file(folder / name, std::string("name: \"$(touch e);`touch f`\"\n") + world);
  const std::string quoted = shell_quoted(name);
  EXPECT_EQ(call(folder, "validate " + quoted).exit_code, 0);
  EXPECT_EQ(call(folder, "run " + quoted + " --film --quiet --out '$(touch g);run'").exit_code, 0);
  EXPECT_EQ(call(folder, "report '$(touch g);run' --figures '`touch h`'").exit_code, 0);
  EXPECT_EQ(call(folder, "sweep " + quoted + " --seeds 1..2 --quiet --out '$(touch i)'").exit_code, 0);
  for (const char letter : std::string("abcdefghi"))
    EXPECT_FALSE(fs::exists(folder / std::string(1, letter))) << letter;
}

TEST(OutputOf, HandsItsWordsOnAsTheyAre) {
  const std::string word = "$(echo x) `y` 'z' \"; |\n";
  EXPECT_EQ(output_of({"printf", "%s", word}), word);
  EXPECT_THROW(output_of({"false"}), std::runtime_error);
  EXPECT_THROW(output_of({"no-such-program-here"}), std::runtime_error);
}

TEST(Limits, AreRaisedByAFlagBeforeTheCommand) {
  const TemporaryFolder folder;
  std::string text = "landmarks:\n  placed:\n";
  for (int i = 0; i < 100; ++i)  // 5 MB of comment
    text += "    - {x_m: " + std::to_string(i % 10 + 2) + ", y_m: " + std::to_string(i / 10 + 2) + "}  # " +
            std::string(50'000, 'x') + "\n";
  test::write_file(folder / "world.yaml", text);
  const Called usual = call(folder, "validate world.yaml");
  EXPECT_EQ(usual.exit_code, 2);
  EXPECT_EQ(usual.errors, "world.yaml: more than 4194304 bytes; seifbed --limits 4 COMMAND allows more\n");
  EXPECT_EQ(call(folder, "--limits 2 validate world.yaml").output, "world.yaml: fine, 100 landmarks\n");
  for (const char* wrong : {"0", "1e9", "many", "nan"})
    EXPECT_EQ(call(folder, std::string("--limits ") + wrong + " validate world.yaml").exit_code, 2) << wrong;
}

}  // namespace
}  // namespace harness
