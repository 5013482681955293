// The text is parsed as a compiler and CMake would parse it.
#include "source.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rooms {
namespace {

std::string words(const std::string& text) {
  std::string joined;
  for (const Token& token : parse_source({"seif/a.cpp", text}).tokens) joined += token.text + " ";
  return joined;
}

TEST(ParseSource, LeavesOutCommentsAndLiterals) {
  EXPECT_EQ(words("a // b\n/* c\n d */ e"), "a e ");
  EXPECT_EQ(words(R"(f("x \" y", 'z', '\'', '"') g)"), "f ( , , , ) g ");
  EXPECT_EQ(words("R\"x(a \" )\" b)x\" c u8R\"(d)\" e"), "c e ");
}

TEST(ParseSource, TakesDigitSeparatorsForNumbers) {
  EXPECT_EQ(words("1'000'000 + 0xff'ff'a b"), "1'000'000 + 0xff'ff'a b ");
}

TEST(ParseSource, EndsWithAnUnfinishedText) {
  EXPECT_EQ(words("a /* b"), "a ");
  EXPECT_EQ(words("a \"b\nc"), "a c ");
  EXPECT_EQ(words("a R\"(b"), "a ");
  EXPECT_EQ(words("#include <a"), "");
}

TEST(ParseSource, FindsIncludesWithTheirLines) {
  const Source source = parse_source({"seif/a.cpp",
                                      "// #include \"a.hpp\"\n"
                                      "#include \"seif/b.hpp\"  // why\n"
                                      "#  include<c>\n"
                                      "/* #include <d> */\n"
                                      "const char* e = R\"(\n#include <e>\n)\";\n"
                                      "#include F\n"});
  ASSERT_EQ(source.includes.size(), 3U);
  EXPECT_EQ(source.includes[0].name, "seif/b.hpp");
  EXPECT_TRUE(source.includes[0].quoted);
  EXPECT_EQ(source.includes[0].line, 2);
  EXPECT_EQ(source.includes[1].name, "c");
  EXPECT_FALSE(source.includes[1].quoted);
  EXPECT_EQ(source.includes[1].line, 3);
  EXPECT_EQ(source.includes[2].name, "");
  EXPECT_EQ(source.includes[2].line, 8);
}

TEST(ParseCmake, FindsCommandsWithTheirArguments) {
  const std::vector<Command> commands = parse_cmake(
      "# add_library(no)\n"
      "Add_Library(seif STATIC\n  a.cpp # b.cpp\n  c.cpp)\n"
      "if(NOT (A AND B))\nendif()\n");
  ASSERT_EQ(commands.size(), 3U);
  EXPECT_EQ(commands[0].name, "add_library");
  EXPECT_EQ(commands[0].line, 2);
  EXPECT_EQ(commands[0].arguments, (std::vector<std::string>{"seif", "STATIC", "a.cpp", "c.cpp"}));
  EXPECT_EQ(commands[1].name, "if");
  EXPECT_EQ(commands[1].arguments, (std::vector<std::string>{"NOT", "A", "AND", "B"}));
  EXPECT_EQ(commands[2].name, "endif");
}

}  // namespace
}  // namespace rooms
