#include "seif/option_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace seif {
namespace {

enum class Colour { red, green };

struct Paint {
  int coats = 2;
  double litres = 1.5;
  Colour colour = Colour::green;
};

OptionTable<Paint> paint_table(const Paint& defaults = {}) {
  OptionTable<Paint> table(defaults);
  table.number(
      "coats", [](Paint& p) -> int& { return p.coats; }, {.min = 1, .max = 9}, "Coats [-].");
  table.number(
      "litres", [](Paint& p) -> double& { return p.litres; }, {.min = 0.0}, "Paint [l].");
  table.choice(
      "colour", [](Paint& p) -> Colour& { return p.colour; },
      OptionChoices<Colour>{{"red", Colour::red}, {"green", Colour::green}}, "Its colour.");
  return table;
}

TEST(OptionTable, DescribesEachOptionWithTheDefaultOfTheStruct) {
  const OptionTable<Paint> table = paint_table({.coats = 3, .litres = 0.5, .colour = Colour::red});
  ASSERT_EQ(table.specs().size(), 3U);
  EXPECT_EQ(table.specs()[0].key, "coats");
  EXPECT_EQ(std::get<std::int64_t>(table.specs()[0].fallback), 3);
  EXPECT_EQ(table.specs()[0].max, 9.0);
  EXPECT_EQ(std::get<double>(table.specs()[1].fallback), 0.5);
  EXPECT_EQ(std::get<std::string>(table.specs()[2].fallback), "red");
  EXPECT_EQ(table.specs()[2].choices, (std::vector<std::string>{"red", "green"}));
}

TEST(OptionTable, ReadsEachOptionIntoItsMember) {
  const Paint chosen =
      paint_table().read({{"coats", std::int64_t{7}}, {"litres", 2.25}, {"colour", std::string("red")}});
  EXPECT_EQ(chosen.coats, 7);
  EXPECT_EQ(chosen.litres, 2.25);
  EXPECT_EQ(chosen.colour, Colour::red);
}

TEST(OptionTable, KeepsTheDefaultsOfWhatItDoesNotDescribe) {
  OptionTable<Paint> table({.coats = 5});
  table.number(
      "litres", [](Paint& p) -> double& { return p.litres; }, {}, "Paint [l].");
  EXPECT_EQ(table.read({{"litres", 4.0}}).coats, 5);
}

/// A default that its own range or choices refuse could not be written into a world file.
TEST(StandardEstimators, TheirDefaultsAreAllowed) {
  const Registry registry = standard_estimators();
  for (const EstimatorType& type : registry.types()) {
    for (const OptionSpec& spec : type.options) {
      const std::string which = type.name + "." + spec.key;
      EXPECT_EQ(spec.help.back(), '.') << which;
      if (const auto* word = std::get_if<std::string>(&spec.fallback)) {
        EXPECT_TRUE(std::ranges::count(spec.choices, *word)) << which;
        continue;
      }
      const double number = std::holds_alternative<double>(spec.fallback)
                                ? std::get<double>(spec.fallback)
                                : static_cast<double>(std::get<std::int64_t>(spec.fallback));
      EXPECT_GE(number, spec.min) << which;
      EXPECT_LE(number, spec.max) << which;
    }
  }
}

}  // namespace
}  // namespace seif
