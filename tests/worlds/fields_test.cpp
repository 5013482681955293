#include "worlds/fields.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "world_files.hpp"
#include "worlds/suggestion.hpp"

namespace worlds {
namespace {

using test::text_of;

struct Thing {
  double length = 1.5;
  double angle = std::numbers::pi / 6;
  int count = 3;
  bool flag = false;
  std::string word = "red";
  Eigen::Vector2d corner{1, 2};
  std::vector<Eigen::Vector2d> line;
  std::vector<double> items;
  Eigen::Vector3d eye{1, 2, 3};
  Eigen::Vector2d size{64, 32};
  std::vector<std::string> shown{"a"};
};

void describe(Fields& fields, Thing& thing) {
  fields.number("length_m", thing.length, more_than_up_to(0, 10), "length");
  fields.angle("angle_deg", thing.angle, between(-180, 180), "angle");
  fields.integer("count", thing.count, between(0, 100), "count");
  fields.boolean("flag", thing.flag, "flag");
  fields.choice("word", thing.word, {"red", "green"}, "colour");
  fields.vector2("corner_m", thing.corner, at_least(0), "corner");
  fields.points("line_m", thing.line, any_number(), 2, "line", Need::optional);
  fields.list(
      "items", thing.items,
      [](Fields& inner, double& item) { inner.number("v_m_s", item, at_least(0), "speed", Need::required); },
      "items");
  fields.vector3("eye_m", thing.eye, between(-9, 9), "eye");
  fields.vector2("size_px", thing.size, even_between(2, 100), "size");
  fields.names("shown", thing.shown, 2, "shown");
}

struct ReadThing {
  Thing thing;
  std::string problems;
  std::string document;
};

ReadThing read(std::string_view text) {
  std::vector<Problem> problems;
  std::optional<Node> node = parse_document(text, "f", problems);
  ReadThing result;
  if (node) {
    const bool good = read_fields(
        *node, [&](Fields& fields) { describe(fields, result.thing); }, problems);
    EXPECT_EQ(good, problems.empty());
    result.document = emit(*node);
  }
  result.problems = text_of(problems);
  return result;
}

TEST(ReadFields, ReadsEveryKindOfValue) {
  const ReadThing result = read(
      "length_m: 2\nangle_deg: 90\ncount: 7\nflag: true\nword: green\ncorner_m: [3, 4.5]\n"
      "line_m: [[0, 0], [-1, 2]]\nitems: [{v_m_s: 1}, {v_m_s: 2}]\n"
      "eye_m: [-1, 0.5, 9]\nsize_px: [100, 2]\nshown: [seif, \"5\"]\n");
  EXPECT_EQ(result.problems, "");
  EXPECT_EQ(result.thing.length, 2.0);
  EXPECT_DOUBLE_EQ(result.thing.angle, std::numbers::pi / 2);
  EXPECT_EQ(result.thing.count, 7);
  EXPECT_TRUE(result.thing.flag);
  EXPECT_EQ(result.thing.word, "green");
  EXPECT_EQ(result.thing.corner, Eigen::Vector2d(3, 4.5));
  EXPECT_EQ(result.thing.line.at(1), Eigen::Vector2d(-1, 2));
  EXPECT_EQ(result.thing.items, (std::vector<double>{1, 2}));
  EXPECT_EQ(result.thing.eye, Eigen::Vector3d(-1, 0.5, 9));
  EXPECT_EQ(result.thing.size, Eigen::Vector2d(100, 2));
  EXPECT_EQ(result.thing.shown, (std::vector<std::string>{"seif", "5"}));
}

TEST(ReadFields, WritesDefaultsIntoTheDocumentAndKeepsTheUsersText) {
  const ReadThing result = read("length_m: 2.50e0\n");
  EXPECT_EQ(result.problems, "");
  EXPECT_EQ(result.document,
            "length_m: 2.50e0\nangle_deg: 30\ncount: 3\nflag: false\nword: red\ncorner_m: [1, 2]\nitems: []\n"
            "eye_m: [1, 2, 3]\nsize_px: [64, 32]\nshown: [a]\n");
}

TEST(ReadFields, ReportsEveryProblemAtItsPlace) {
  const ReadThing result = read(
      "lenght_m: 2\nangle_deg: .nan\ncount: 1.5\nflag: yes\nword: gren\ncorner_m: [1, -2]\n"
      "line_m: [[0, 0]]\nitems:\n  - {v_m_s: -1}\n  - {}\n  - 7\n");
  EXPECT_EQ(result.problems,
            "f:2:12: 'angle_deg' must be a finite number, not '.nan'\n"
            "f:3:8: 'count' must be a whole number, not '1.5'\n"
            "f:4:7: 'flag' must be true or false, not 'yes'\n"
            "f:5:7: 'word' must be one of red, green, not 'gren' (did you mean 'green'?)\n"
            "f:6:15: 'corner_m' must be at least 0 m, not '-2'\n"
            "f:7:9: 'line_m' must have at least 2 points, not 1\n"
            "f:9:13: 'v_m_s' must be at least 0 m/s, not '-1'\n"
            "f:10:5: the key 'v_m_s' is missing\n"
            "f:11:5: 'items' must be a map, not '7'\n"
            "f:1:1: unknown key 'lenght_m' (did you mean 'length_m'?)\n");
}

TEST(ReadFields, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"\"5\"", "five", "0x10", "1e", "--1", "+-1", "1.2.3", "[1]", "{a: 1}", "~", "1_000", "5 m"}) {
    EXPECT_NE(read(std::string("length_m: ") + text + "\n").problems.find("must be a number"),
              std::string::npos)
        << text;
  }
  for (const char* text : {"inf", "-.inf", ".NaN", "1e999"}) {
    EXPECT_NE(read(std::string("length_m: ") + text + "\n").problems.find("finite"), std::string::npos)
        << text;
  }
  for (const char* text : {"0", "-1", "10.0000001"}) {
    EXPECT_EQ(read(std::string("length_m: ") + text + "\n").problems,
              std::string("f:1:11: 'length_m' must be more than 0 and at most 10 m, not '") + text + "'\n");
  }
  for (const char* text : {"5", "+5", "5.", ".5", "5e0", "1E-2"}) {
    EXPECT_EQ(read(std::string("length_m: ") + text + "\n").problems, "") << text;
  }
}

TEST(ReadFields, RefusesVectorsOfAnotherLength) {
  EXPECT_EQ(read("eye_m: [1, 2]\n").problems, "f:1:8: 'eye_m' must be a triple [x, y, z], not a list\n");
  EXPECT_EQ(read("corner_m: [1, 2, 3]\n").problems, "f:1:11: 'corner_m' must be a pair [x, y], not a list\n");
  EXPECT_EQ(read("eye_m: [1, 2, 10]\n").problems,
            "f:1:15: 'eye_m' must be at least -9 and at most 9 m, not '10'\n");
  EXPECT_EQ(read("eye_m: 5\n").thing.eye, Eigen::Vector3d(1, 2, 3));
}

TEST(ReadFields, RefusesWhatIsNotEven) {
  EXPECT_EQ(read("size_px: [3, 2.5]\n").problems,
            "f:1:11: 'size_px' must be a multiple of 2, at least 2 and at most 100 px, not '3'\n"
            "f:1:14: 'size_px' must be a multiple of 2, at least 2 and at most 100 px, not '2.5'\n");
  EXPECT_NE(read("size_px: [0, 102]\n").problems, "");
  EXPECT_EQ(read("size_px: [2, 100]\n").problems, "");
}

TEST(ReadFields, RefusesListsThatAreNoNames) {
  EXPECT_EQ(read("shown: seif\n").problems, "f:1:8: 'shown' must be a list of names, not 'seif'\n");
  EXPECT_EQ(read("shown: [a, b, c]\n").problems, "f:1:8: 'shown' must have at most 2 names, not 3\n");
  EXPECT_EQ(read("shown: [a, a]\n").problems, "f:1:12: 'a' stands twice\n");
  EXPECT_EQ(read("shown: [a, 5]\n").problems, "f:1:12: 'shown' must be a text (put it in quotes), not '5'\n");
  EXPECT_EQ(read("shown: [{}, []]\n").problems,
            "f:1:9: 'shown' must be a text, not a map\nf:1:13: 'shown' must be a text, not a list\n");
  EXPECT_NE(read("shown: [\"a b\"]\n").problems.find("letters, digits"), std::string::npos);
  EXPECT_EQ(read("shown: [a, a]\n").thing.shown, std::vector<std::string>{"a"});
}

TEST(ReadFields, RefusesIntegersThatDoNotFit) {
  EXPECT_NE(read("count: 99999999999999999999\n").problems, "");
  EXPECT_NE(read("count: 101\n").problems, "");
  EXPECT_NE(read("count: -1\n").problems, "");
}

TEST(ReadFields, SaysToWhichKindAForeignKeyBelongs) {
  std::string kind = "a";
  double x = 1;
  double y = 1;
  const auto describe_kinds = [&](Fields& fields) {
    fields.variant("type", kind,
                   {{"a", "", [&](Fields& inner) { inner.number("x_m", x, any_number(), ""); }},
                    {"b", "", [&](Fields& inner) { inner.number("y_m", y, any_number(), ""); }},
                    {"c", "", [&](Fields& inner) { inner.number("y_m", y, any_number(), ""); }}},
                   "");
  };
  const auto problems_of = [&](std::string_view text) {
    std::vector<Problem> problems;
    std::optional<Node> node = parse_document(text, "f", problems);
    read_fields(*node, describe_kinds, problems);
    return text_of(problems);
  };
  EXPECT_EQ(problems_of("y_m: 1\n"), "f:1:1: 'y_m' does not belong to type 'a', but to 'b', 'c'\n");
  EXPECT_EQ(problems_of("{type: c, y_m: 4}\n"), "");
  EXPECT_EQ(y, 4.0);
  EXPECT_EQ(problems_of("{type: d, y_m: 4}\n"), "f:1:8: 'type' must be one of a, b, c, not 'd'\n");
}

TEST(ReadFields, ReadsEveryDefaultAngleBackToTheSameBits) {
  for (int i = -1000; i <= 1000; ++i) {
    double angle = 0.001 * i * std::numbers::pi;
    std::vector<Problem> problems;
    std::optional<Node> node = parse_document("{}", "f", problems);
    const auto describe_angle = [&](Fields& fields) { fields.angle("a_deg", angle, any_number(), ""); };
    read_fields(*node, describe_angle, problems);
    const double first = angle;
    std::optional<Node> again = parse_document(emit(*node), "f", problems);
    angle = 0;
    read_fields(*again, describe_angle, problems);
    EXPECT_EQ(angle, first);
    EXPECT_NEAR(angle, 0.001 * i * std::numbers::pi, 1e-15);
  }
}

TEST(Suggestion, NamesTheNearestOrNothing) {
  EXPECT_EQ(suggestion("max_rang_m", {"max_range_m", "fov_deg"}), " (did you mean 'max_range_m'?)");
  EXPECT_EQ(suggestion("elephant", {"max_range_m", "fov_deg"}), "");
  EXPECT_EQ(suggestion(std::string(100000, 'x'), {"max_range_m"}), "");
  EXPECT_EQ(suggestion("x", {"id", "y_m", "x_m"}), " (did you mean 'x_m'?)");
  EXPECT_EQ(suggestion("range_m", {"rate_hz", "max_range_m"}), " (did you mean 'max_range_m'?)");
  EXPECT_EQ(suggestion("max_range", {"max_range_m", "max_range_sd_m"}), " (did you mean 'max_range_m'?)");
  EXPECT_EQ(suggestion("robot_mass_kg", {"robot", "mass_kg"}), " (did you mean 'mass_kg'?)");
  EXPECT_EQ(suggestion("m", {"max_range_m", "y_m"}), "") << "a unit alone";
  EXPECT_EQ(suggestion("--sed", {"--set", "--seed"}), " (did you mean '--seed'?)") << "a letter left out";
}

}  // namespace
}  // namespace worlds
