#include "worlds/document.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "world_files.hpp"

namespace worlds {
namespace {

using test::text_of;

std::string syntax_problems_of(std::string_view text) {
  std::vector<Problem> problems;
  const std::optional<Node> node = parse_document(text, "f.yaml", problems);
  EXPECT_EQ(node.has_value(), problems.empty());
  return text_of(problems);
}

TEST(ParseDocument, KeepsOrderTextAndPlace) {
  std::vector<Problem> problems;
  const auto root = parse_document("b: 1.50\na:\n  - x: \"0\"\n", "f.yaml", problems);
  ASSERT_TRUE(root) << text_of(problems);
  ASSERT_EQ(root->entries.size(), 2U);
  EXPECT_EQ(root->entries[0].key, "b");
  EXPECT_EQ(root->entries[0].value.text, "1.50");
  EXPECT_FALSE(root->entries[0].value.quoted);
  const Node* x = find_path(*root, "a.0.x");
  ASSERT_NE(x, nullptr);
  EXPECT_TRUE(x->quoted);
  EXPECT_EQ(x->where.line, 3);
  EXPECT_EQ(x->where.column, 8);
  EXPECT_EQ(find_path(*root, "a.1.x"), nullptr);
}

TEST(ParseDocument, RefusesEachDuplicateKeyAtItsPlace) {
  EXPECT_EQ(syntax_problems_of("a: 1\nb: {c: 1, c: 2}\na: 2\n"),
            "f.yaml:2:11: the key 'c' stands here twice: first in line 2\n"
            "f.yaml:3:1: the key 'a' stands here twice: first in line 1\n");
}

TEST(ParseDocument, SaysWhereTheSyntaxBreaks) {
  EXPECT_EQ(syntax_problems_of("a: 1\nb: [1, 2\nc: 3\n").substr(0, 9), "f.yaml:3:");
  EXPECT_NE(syntax_problems_of("a: b: c\n"), "");
  EXPECT_NE(syntax_problems_of("\tx: 1\n"), "");
  EXPECT_NE(syntax_problems_of("a: *nobody\n"), "");
}

TEST(ParseDocument, RefusesWhatIsNotOneDocument) {
  EXPECT_NE(syntax_problems_of("").find("empty"), std::string::npos);
  EXPECT_NE(syntax_problems_of("# a comment alone\n").find("empty"), std::string::npos);
  EXPECT_NE(syntax_problems_of("a: 1\n---\nb: 2\n").find("one document"), std::string::npos);
  EXPECT_NE(syntax_problems_of("a: !!str 5\n").find("tag"), std::string::npos);
  EXPECT_NE(syntax_problems_of("? [1, 2]\n: 3\n").find("plain word"), std::string::npos);
}

TEST(ParseDocument, RefusesTextThatIsNotUtf8) {
  EXPECT_EQ(syntax_problems_of("a: 1\nb: \xff\n"),
            "f.yaml:2:4: the byte 0xff does not belong in a UTF-8 text file\n");
  EXPECT_NE(syntax_problems_of("a: \xc0\xaf\n"), "");           // overlong
  EXPECT_NE(syntax_problems_of("a: \xed\xa0\x80\n"), "");       // a surrogate
  EXPECT_NE(syntax_problems_of("a: \xe2\x82"), "");             // cut off
  EXPECT_NE(syntax_problems_of(std::string("a\0: 1", 6)), "");  // UTF-16 without a mark
  EXPECT_EQ(syntax_problems_of("a: \xe2\x82\xac \xf0\x9f\x8c\xb3\n"), "");
}

TEST(ParseDocument, GivesUpOnNestingThatIsTooDeep) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(syntax_problems_of(nested(max_depth)), "");
  EXPECT_NE(syntax_problems_of(nested(max_depth + 1)).find("nested"), std::string::npos);
  EXPECT_NE(syntax_problems_of(nested(100000)).find("nested"), std::string::npos);
}

TEST(ParseDocument, GivesUpOnAliasBombs) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {  // each line refers nine times to the line before
    bomb += fmt::format("a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}]\n", i,
                        i - 1);
  }
  EXPECT_NE(syntax_problems_of(bomb).find("more than 1000000 values"), std::string::npos);
  EXPECT_NE(syntax_problems_of("a: &a [*a]\n"), "");
}

TEST(ParseDocument, ExpandsAliases) {
  std::vector<Problem> problems;
  const auto root = parse_document("a: &p {x: 1}\nb: *p\n", "f.yaml", problems);
  ASSERT_TRUE(root) << text_of(problems);
  EXPECT_EQ(find_path(*root, "b.x")->text, "1");
}

TEST(ReadDocument, RefusesWhatIsNoReadableFile) {
  const test::Folder folder;
  std::vector<Problem> problems;
  EXPECT_FALSE(read_document(folder.path(), problems));
  EXPECT_FALSE(read_document(folder.path() / "nothing.yaml", problems));
  EXPECT_FALSE(read_document(folder.write("empty.yaml", ""), problems));
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_NE(problems[0].message.find("directory"), std::string::npos);
  EXPECT_NE(problems[1].message.find("no such file"), std::string::npos);
  EXPECT_NE(problems[2].message.find("empty"), std::string::npos);
}

TEST(Emit, GivesTextThatParsesToTheSameTree) {
  const std::string_view text =
      "n: 1e-3\nquoted: \"5\"\nodd: 'a \"b\" \\ # c: {}'\nlines: |\n  one\n  two\nempty: {}\nnone: "
      "[]\nnothing: ~\n"
      "deep:\n  - {x: 1, y: [1, 2]}\n  - [[1, 2], [3, 4]]\n  - - - 7\nwords: a plain text, with a comma\n";
  std::vector<Problem> problems;
  const auto first = parse_document(text, "f", problems);
  ASSERT_TRUE(first) << text_of(problems);
  const std::string once = emit(*first);
  const auto second = parse_document(once, "g", problems);
  ASSERT_TRUE(second) << once << text_of(problems);
  EXPECT_EQ(emit(*second), once);
  EXPECT_EQ(second->find("n")->text, "1e-3");
  EXPECT_FALSE(second->find("n")->quoted);
  EXPECT_TRUE(second->find("quoted")->quoted);
  EXPECT_EQ(second->find("odd")->text, first->find("odd")->text);
  EXPECT_EQ(second->find("lines")->text, "one\ntwo\n");
  EXPECT_EQ(second->find("words")->text, "a plain text, with a comma");
  EXPECT_EQ(find_path(*second, "deep.2.0.0")->text, "7");
}

}  // namespace
}  // namespace worlds
