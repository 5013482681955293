#include "worlds/key_tables.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "worlds/schema.hpp"

namespace worlds {
namespace {

using Json = nlohmann::json;

EstimatorSchemas one_estimator() {
  EstimatorSchemas schemas;
  schemas.types["mine"] = [](Fields& fields, std::map<std::string, OptionValue>&) {
    double value = 1.0;
    fields.number("secret", value, any_number(), "an option");
  };
  return schemas;
}

/// Each key of a schema, however deep, must begin a row.
void expect_rows(const Json& schema, const std::string& tables) {
  if (schema.contains("items")) expect_rows(schema["items"], tables);
  if (!schema.contains("properties")) return;
  for (const auto& [key, inner] : schema["properties"].items()) {
    const bool is_section =
        inner.contains("properties") || inner.dump().find("\"properties\"") != std::string::npos;
    if (!is_section) {
      EXPECT_NE(tables.find("| `" + key + "` |"), std::string::npos) << key;
    }
    if (key != "estimators") expect_rows(inner, tables);
  }
}

TEST(KeyTables, HaveEveryKeyOfTheSchema) {
  expect_rows(Json::parse(json_schema(one_estimator())), key_tables(one_estimator()));
}

TEST(KeyTables, LeaveOutTheOptionsOfEstimators) {
  const std::string tables = key_tables(one_estimator());
  EXPECT_EQ(tables.find("secret"), std::string::npos);
  EXPECT_NE(tables.find("`mine`"), std::string::npos);
}

TEST(KeyTables, TellDefaultsLimitsUnitsAndWhichKindAKeyBelongsTo) {
  const std::string tables = key_tables(one_estimator());
  const auto has = [&](const std::string& text) { return tables.find(text) != std::string::npos; };
  EXPECT_TRUE(has("| `duration_s` | number > 0 and ≤ 1000000 | `60` | length of the run [s] |"));
  EXPECT_TRUE(has("| `lane_m` | number > 0 and ≤ 100000 | `2` |"));
  EXPECT_TRUE(has("(only with `mode: serpentine`)"));
  EXPECT_TRUE(has("| `file` | text | *required* |"));
}

}  // namespace
}  // namespace worlds
