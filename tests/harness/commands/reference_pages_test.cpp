// The reference pages are what the program prints.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "harness/command_call.hpp"
#include "harness/recording/run_folder.hpp"

namespace harness {
namespace {

std::string page(const std::string& path) {
  std::ifstream file(std::string(SEIFBED_SOURCE_DIR) + "/" + path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string printed(const std::string& arguments) {
  const TemporaryFolder folder;
  const test::Called called = test::call(folder, arguments);
  EXPECT_EQ(called.exit_code, 0) << called.errors;
  return called.output;
}

TEST(ReferencePages, TellAllKeysOfWorldFiles) {
  EXPECT_EQ(page("worlds/keys.md"), printed("schema --markdown"))
      << "./seifbed schema --markdown > worlds/keys.md";
}

TEST(ReferencePages, TellAllOptionsOfEstimators) {
  EXPECT_EQ(page("docs/estimators.md"), printed("estimators --markdown"))
      << "./seifbed estimators --markdown > docs/estimators.md";
}

}  // namespace
}  // namespace harness
