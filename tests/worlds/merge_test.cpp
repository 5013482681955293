#include "worlds/merge.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "world_files.hpp"

namespace worlds {
namespace {

using test::Folder;
using test::text_of;

Node parse(std::string_view text) {
  std::vector<Problem> problems;
  std::optional<Node> node = parse_document(text, "f.yaml", problems);
  EXPECT_TRUE(node) << text_of(problems);
  return node ? *std::move(node) : Node{};
}

std::string set(Node& root, const std::string& assignment) {
  std::vector<Problem> problems;
  apply_override(root, assignment, problems);
  return text_of(problems);
}

TEST(Extends, MergesMapsKeyByKeyAndReplacesTheRest) {
  const Folder folder;
  folder.write("base.yaml", "a: {x: 1, y: 2, gone: 3}\nlist: [1, 2, 3]\nkept: 4\n");
  folder.write("sub/middle.yaml", "extends: ../base.yaml\na: {x: 10}\n");
  const auto file = folder.write("top.yaml", "extends: sub/middle.yaml\na: {z: 5, gone: null}\nlist: [9]\n");
  std::vector<Problem> problems;
  const auto root = read_extended_document(file, problems);
  ASSERT_TRUE(root) << text_of(problems);
  EXPECT_EQ(emit(*root), "a:\n  x: 10\n  y: 2\n  z: 5\nlist: [9]\nkept: 4\n");
  EXPECT_NE(find_path(*root, "a.y")->where.source->find("base.yaml"), std::string::npos);
  EXPECT_NE(find_path(*root, "a.z")->where.source->find("top.yaml"), std::string::npos);
}

TEST(Extends, ShowsTheChainOfACircle) {
  const Folder folder;
  const auto a = folder.write("a.yaml", "extends: b.yaml\n");
  folder.write("b.yaml", "x: 1\nextends: ./sub/../c.yaml\n");
  folder.write("c.yaml", "extends: a.yaml\n");
  std::filesystem::create_directory(folder.path() / "sub");
  std::vector<Problem> problems;
  EXPECT_FALSE(read_extended_document(a, problems));
  const std::string folder_name = folder.path().string();
  EXPECT_EQ(text_of(problems), folder_name + "/c.yaml:1:10: 'extends' goes in a circle: " + folder_name +
                                   "/a.yaml -> " + folder_name + "/b.yaml -> " + folder_name + "/c.yaml -> " +
                                   folder_name + "/a.yaml\n");
}

TEST(Extends, RefusesWhatIsNoFileAtItsPlace) {
  const Folder folder;
  std::vector<Problem> problems;
  EXPECT_FALSE(read_extended_document(folder.write("a.yaml", "x: 1\nextends: missing.yaml\n"), problems));
  EXPECT_FALSE(read_extended_document(folder.write("b.yaml", "extends: [a.yaml]\n"), problems));
  EXPECT_FALSE(read_extended_document(folder.write("c.yaml", "extends: .\n"), problems));
  EXPECT_FALSE(read_extended_document(folder.write("d.yaml", "extends:\n"), problems));
  ASSERT_EQ(problems.size(), 4U);
  EXPECT_NE(to_string(problems[0]).find("a.yaml:2:10: "), std::string::npos);
}

TEST(Override, SetsValuesInMapsAndLists) {
  Node root = parse("a: {b: 1}\nlist: [{n: 1}, {n: 2}]\n");
  EXPECT_EQ(set(root, "a.b=2.50"), "");
  EXPECT_EQ(set(root, "a.new.deep={x: [1, 2]}"), "");
  EXPECT_EQ(set(root, "list.1.n=7"), "");
  EXPECT_EQ(set(root, "list.0={m: 3}"), "");
  EXPECT_EQ(find_path(root, "a.b")->text, "2.50");
  EXPECT_EQ(find_path(root, "a.new.deep.x.1")->text, "2");
  EXPECT_EQ(find_path(root, "list.1.n")->text, "7");
  EXPECT_EQ(find_path(root, "list.0.n"), nullptr);
  EXPECT_EQ(*find_path(root, "a.new.deep.x.1")->where.source, "--set a.new.deep={x: [1, 2]}");
}

TEST(Override, NamesItselfInItsProblemsAndChangesNothing) {
  Node root = parse("a: {b: 1}\nlist: [1]\n");
  const std::string before = emit(root);
  EXPECT_EQ(set(root, "list.1=5"), "--set list.1=5: '1' is no index of a list of 1: the first item is 0\n");
  for (const char* assignment : {"a.b.c=1", "list.x=1", "a", "=1", "a..b=1", "a.b=[1", "a.b=", "new.x.=1",
                                 "extends=x", "a b.c=1", "a.\xe1=1", "a.b\n=1"}) {
    EXPECT_EQ(set(root, assignment).find(std::string("--set ") + assignment + ": "), 0U) << assignment;
  }
  EXPECT_EQ(emit(root), before);
}

}  // namespace
}  // namespace worlds
