// This tree follows its architecture.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "floors.hpp"
#include "includes.hpp"
#include "rules.hpp"
#include "sizes.hpp"
#include "source.hpp"

namespace rooms {
namespace {

/// One finding a line, as a compiler prints them.
std::string listed(const Findings& findings) {
  std::string text;
  for (const std::string& finding : findings) text += finding + "\n";
  return text;
}

std::vector<Source> tree_sources() {
  std::vector<Source> sources;
  for (const TextFile& file : read_sources(SEIFBED_SOURCE_DIR)) sources.push_back(parse_source(file));
  return sources;
}

TEST(Tree, IsRead) {
  const std::vector<Source> sources = tree_sources();
  const auto types = std::ranges::find(sources, "seif/types.hpp", &Source::path);
  ASSERT_NE(types, sources.end());
  EXPECT_FALSE(types->includes.empty());
  EXPECT_FALSE(types->tokens.empty());
}

TEST(Tree, EverySourceKeepsToItsRoom) {
  Findings findings;
  for (const Source& source : tree_sources())
    std::ranges::copy(check_source(source), std::back_inserter(findings));
  EXPECT_EQ(listed(findings), "");
}

TEST(Tree, ArrowsInHarnessRunDown) {
  Findings findings;
  for (const Source& source : tree_sources())
    std::ranges::copy(check_floors(source), std::back_inserter(findings));
  EXPECT_EQ(listed(findings), "");
  EXPECT_EQ(listed(check_top_of_harness(list_tree(SEIFBED_SOURCE_DIR))), "");
}

TEST(Tree, FilesIncludeTheStandardHeadersThatTheyUse) {
  EXPECT_EQ(listed(check_standard_headers(tree_sources())), "");
}

TEST(Tree, HeadersFunctionsAndClassesAreSmall) {
  Findings findings;
  for (const TextFile& file : read_sources(SEIFBED_SOURCE_DIR)) {
    if (file.path.starts_with("tests/")) continue;
    std::ranges::copy(check_header_length(file), std::back_inserter(findings));
    std::ranges::copy(check_private_functions(parse_source(file)), std::back_inserter(findings));
    std::ranges::copy(check_function_lengths(parse_source(file)), std::back_inserter(findings));
  }
  EXPECT_EQ(listed(findings), "");
}

TEST(Tree, NoRoomHandsItsLibrariesOn) { EXPECT_EQ(listed(check_reach(tree_sources())), ""); }

TEST(Tree, LinkLinesFollowTheArrows) {
  const std::vector<TextFile> files = read_cmake_lists(SEIFBED_SOURCE_DIR);
  EXPECT_GE(files.size(), 5U);
  Findings findings;
  for (const TextFile& file : files) std::ranges::copy(check_cmake_lists(file), std::back_inserter(findings));
  EXPECT_EQ(listed(findings), "");
}

TEST(Tree, HasOnlyTheEntriesOfTheArchitecture) {
  const std::vector<std::string> paths = list_tree(SEIFBED_SOURCE_DIR);
  EXPECT_NE(std::ranges::find(paths, "CMakeLists.txt"), paths.end());
  EXPECT_EQ(listed(check_paths(paths)), "");
}

}  // namespace
}  // namespace rooms
