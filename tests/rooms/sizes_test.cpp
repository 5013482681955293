// Headers and functions that are too long are found, and others are not.
#include "sizes.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rooms {
namespace {

std::string lines(int n) {
  std::string text;
  for (int i = 0; i < n; ++i) text += "a();\n";
  return text;
}

TEST(Sizes, OfHeadersAreBounded) {
  EXPECT_EQ(check_header_length({"seif/a.hpp", lines(150)}), no_findings);
  EXPECT_EQ(check_header_length({"seif/a.cpp", lines(151)}), no_findings);
  const Findings expected = {"seif/a.hpp:1: a header of 151 lines"};
  EXPECT_EQ(check_header_length({"seif/a.hpp", lines(151)}), expected);
}

TEST(Sizes, OfFunctionsAreBounded) {
  for (const std::string head :
       {"void f() ", "int A::f(int x) const ", "A::A() : a_(1) ", "void f() noexcept "}) {
    EXPECT_EQ(check_function_lengths(parse_source({"a.cpp", head + "{\n" + lines(48) + "}\n"})), no_findings)
        << head;
    const Findings expected = {"a.cpp:1: a function of 51 lines"};
    EXPECT_EQ(check_function_lengths(parse_source({"a.cpp", head + "{\n" + lines(49) + "}\n"})), expected)
        << head;
  }
}

TEST(Sizes, OfNamespacesAndClassesAreNot) {
  EXPECT_EQ(
      check_function_lengths(parse_source({"a.cpp", "namespace a {\nclass A {\n" + lines(80) + "};\n}\n"})),
      no_findings);
}

TEST(Sizes, AreThoseOfEachFunctionInTurn) {
  const std::string text = "void f() {\nif (a) {\n" + lines(20) + "}\n}\nvoid g() {\n" + lines(60) + "}\n";
  const Findings expected = {"a.cpp:25: a function of 62 lines"};
  EXPECT_EQ(check_function_lengths(parse_source({"a.cpp", text})), expected);
}

TEST(Sizes, OfClassesAreBoundedByTheirPrivateFunctions) {
  const std::string open = "class A final : public B<C> {\n public:\n  void a();\n private:\n";
  const std::string fields =
      "  std::function<void(int)> f_;\n  int x_ = sum(1, 2);\n  struct S { int g(); int h(); };\n";
  std::string functions;
  for (int i = 0; i < 29; ++i) functions += "  int f(int x) const { return g(x); }\n";
  const std::string last = "  void g(int);\n";
  EXPECT_EQ(check_private_functions(parse_source({"a.hpp", open + fields + functions + last + "};\n"})),
            no_findings);
  const Findings expected = {"a.hpp:1: A has 31 private functions"};
  EXPECT_EQ(
      check_private_functions(parse_source({"a.hpp", open + functions + fields + last + last + "};\n"})),
      expected);
}

}  // namespace
}  // namespace rooms
