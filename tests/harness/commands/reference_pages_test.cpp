// The reference pages are what the program prints.

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
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

/// Expects finite bounds of every number in a schema. `path` is where it stands.
void expect_bounds(const nlohmann::json& schema, const std::string& path) {
  if (schema.is_object() && schema.contains("type") &&
      (schema["type"] == "number" || schema["type"] == "integer")) {
    const char* least = schema.contains("minimum") ? "minimum" : "exclusiveMinimum";
    ASSERT_TRUE(schema.contains(least) && schema.contains("maximum")) << path;
    const double largest = schema["type"] == "number" ? 1e12 : 9223372036854775807.0;
    EXPECT_GE(schema[least].get<double>(), -1e12) << path;
    EXPECT_LE(schema["maximum"].get<double>(), largest) << path;
  }
  if (!schema.is_structured()) return;
  for (const auto& [key, inner] : schema.items()) expect_bounds(inner, path + '/' + key);
}

TEST(Schema, BoundsEveryNumberFromBelowAndAbove) {
  const auto schema = nlohmann::json::parse(printed("schema"));
  EXPECT_EQ(schema["properties"]["seed"]["maximum"].get<std::int64_t>(),
            std::numeric_limits<std::int64_t>::max());
  expect_bounds(schema, "");
}

TEST(ReferencePages, TellAllOptionsOfEstimators) {
  EXPECT_EQ(page("docs/estimators.md"), printed("estimators --markdown"))
      << "./seifbed estimators --markdown > docs/estimators.md";
}

}  // namespace
}  // namespace harness
