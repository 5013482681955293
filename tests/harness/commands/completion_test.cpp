// The completion of shells, and the man page, know everything that the help knows.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::call;
using test::call_program;
using test::Called;

using Names = std::set<std::string>;

Names matches(const std::string& text, const std::regex& pattern) {
  Names names;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    names.insert((*match)[1]);
  return names;
}

/// The commands that `seifbed help` lists.
Names commands(const TemporaryFolder& folder) {
  const std::string help = call(folder, "help").output;
  return matches(help.substr(help.find("Subcommands:")), std::regex("\n  ([a-z]+) "));
}

/// All options of all commands.
Names options(const TemporaryFolder& folder) {
  Names all;
  for (const std::string& command : commands(folder)) {
    const std::string help = call(folder, "help " + command).output;
    for (const char* names : {"\n  (--?[a-z-]+)", "\n  --?[a-z-]+,(--?[a-z-]+)"})
      all.merge(matches(help.substr(0, help.find("Example")), std::regex(names)));
  }
  return all;
}

std::string without_escapes(const std::string& page) {
  return std::regex_replace(page, std::regex(R"(\\-)"), "-");
}

TEST(Completion, AndManPageHoldEveryCommandAndOption) {
  const TemporaryFolder folder;
  const std::string texts[] = {call(folder, "completion bash").output, call(folder, "completion zsh").output,
                               without_escapes(call(folder, "man").output)};
  const Names all = commands(folder);
  EXPECT_TRUE(all.contains("run") && all.contains("estimators") && all.contains("man")) << all.size();
  Names words = options(folder);
  EXPECT_TRUE(words.contains("--seed") && words.contains("-o") && words.contains("--slurm")) << words.size();
  words.insert(all.begin(), all.end());
  for (const std::string& text : texts) {
    for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word;
  }
}

TEST(Completion, OfBashIsAScriptThatCompletes) {
  const TemporaryFolder folder;
  test::write_file(folder / "script", call(folder, "completion bash").output);
  EXPECT_EQ(call_program(folder, "bash -n script").errors, "");
  const auto completed = [&](const std::string& words, int at) {
    return call_program(folder, "bash -c \". ./script; COMP_WORDS=(" + words + "); COMP_CWORD=" +
                                    std::to_string(at) + "; _seifbed; echo \\${COMPREPLY[*]}\"")
        .output;
  };
  EXPECT_EQ(completed("seifbed ru", 1), "run\n");
  EXPECT_EQ(completed("seifbed run --se", 2), "--set --seed\n");
  EXPECT_EQ(completed("seifbed --limits 4 run --dur", 4), "--duration\n");
  EXPECT_EQ(completed("seifbed export x --format g", 4), "g2o gtsam\n");
  EXPECT_EQ(completed("seifbed help comp", 2), "compare completion\n");
  EXPECT_EQ(completed("seifbed completion z", 2), "zsh\n");
  EXPECT_EQ(completed("seifbed run wor", 2), "\n") << "bash completes files then";
}

TEST(Completion, OfZshIsAcceptedByZsh) {
  const TemporaryFolder folder;
  if (call_program(folder, "command -v zsh >/dev/null").exit_code != 0) GTEST_SKIP() << "there is no zsh";
  test::write_file(folder / "script", call(folder, "completion zsh").output);
  EXPECT_EQ(call_program(folder, "zsh -n script").errors, "");
}

TEST(ManPage, IsAcceptedByGroffWithoutAWarning) {
  const TemporaryFolder folder;
  if (call_program(folder, "command -v groff >/dev/null").exit_code != 0) GTEST_SKIP() << "there is no groff";
  test::write_file(folder / "page", call(folder, "man").output);
  const Called page = call_program(folder, "groff -ww -man -Tutf8 page");
  EXPECT_EQ(page.errors, "");
  EXPECT_NE(page.output.find("theta_x=4,6,8,16"), std::string::npos) << "an example of sweep";
}

TEST(Completion, RefusesOtherShells) {
  const TemporaryFolder folder;
  const Called called = call(folder, "completion fish");
  EXPECT_EQ(called.exit_code, 2);
  EXPECT_NE(called.errors.find("one of bash, zsh"), std::string::npos) << called.errors;
}

}  // namespace
}  // namespace harness
