// A missing standard header is found, even if another header would have brought it.
#include "includes.hpp"

#include <gtest/gtest.h>

namespace rooms {
namespace {

TEST(StandardHeaders, ComeFromTheFileOrItsOwnHeader) {
  const Source header = parse_source({"seif/a.hpp", "#include <vector>\nstd::vector<int> f();\n"});
  const Source file = parse_source(
      {"seif/a.cpp",
       "#include \"seif/a.hpp\"\n#include <cmath>\nstd::vector<int> f() { return {std::sqrt(4)}; }\n"});
  EXPECT_EQ(check_standard_headers({header, file}), no_findings);
}

TEST(StandardHeaders, AreMissedOnceForEachFile) {
  const Source other = parse_source({"seif/b.hpp", "#include <vector>\n"});
  const Source file = parse_source(
      {"seif/a.cpp",
       "#include \"seif/b.hpp\"\nstd::vector<int> f();\nstd::vector<int> g();\nstd::span<int> h();\n"});
  const Findings expected = {"seif/a.cpp:2: uses std::vector without <vector>",
                             "seif/a.cpp:4: uses std::span without <span>"};
  EXPECT_EQ(check_standard_headers({other, file}), expected);
}

TEST(StandardHeaders, AreNotAskedForNamesOfOthers) {
  EXPECT_EQ(check_standard_headers({parse_source({"a.cpp", "fmt::string a; // std::vector\nstd::b c;\n"})}),
            no_findings);
}

}  // namespace
}  // namespace rooms
