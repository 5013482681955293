#include "worlds/schema.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "world_files.hpp"

namespace worlds {
namespace {

using Json = nlohmann::json;
using test::fake_estimators;
using test::Folder;

/// A scalar in the reading of YAML 1.2's core schema.
Json to_json(const Node& node) {
  if (node.kind == Node::Kind::null) return nullptr;
  if (node.kind == Node::Kind::sequence) {
    Json list = Json::array();
    for (const Node& item : node.items) list.push_back(to_json(item));
    return list;
  }
  if (node.kind == Node::Kind::map) {
    Json map = Json::object();
    for (const Node::Entry& entry : node.entries) map[entry.key] = to_json(entry.value);
    return map;
  }
  if (node.quoted) return node.text;
  if (node.text == "true" || node.text == "false") return node.text == "true";
  const char* const end = node.text.data() + node.text.size();
  std::int64_t integer = 0;
  if (const auto [stop, error] = std::from_chars(node.text.data(), end, integer);
      error == std::errc() && stop == end) {
    return integer;
  }
  double number = 0;
  if (const auto [stop, error] = std::from_chars(node.text.data(), end, number);
      error == std::errc() && stop == end) {
    return number;
  }
  return node.text;
}

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  return type == "number" && value.is_number();
}

bool is_valid(const Json& schema, const Json& value);

bool object_is_valid(const Json& schema, const Json& value) {
  for (const auto& key : schema.value("required", Json::array())) {
    if (!value.contains(key.get<std::string>())) return false;
  }
  for (const auto& [key, inner] : value.items()) {
    if (schema.contains("propertyNames") && !is_valid(schema["propertyNames"], key)) return false;
    const bool known = schema.contains("properties") && schema["properties"].contains(key);
    const Json rule = known ? schema["properties"][key] : schema.value("additionalProperties", Json(true));
    if (!is_valid(rule, inner)) return false;
  }
  return true;
}

bool number_is_valid(const Json& schema, const Json& value) {
  const auto number = value.get<double>();
  if (schema.contains("minimum") && number < schema["minimum"].get<double>()) return false;
  if (schema.contains("exclusiveMinimum") && number <= schema["exclusiveMinimum"].get<double>()) return false;
  const double step = schema.value("multipleOf", 0.0);
  if (step > 0 && std::fmod(number, step) != 0) return false;
  return !schema.contains("maximum") || number <= schema["maximum"].get<double>();
}

bool array_is_valid(const Json& schema, const Json& value) {
  if (value.size() < schema.value("minItems", std::size_t{0})) return false;
  if (value.size() > schema.value("maxItems", value.size())) return false;
  if (schema.value("uniqueItems", false) &&
      std::set<Json>(value.begin(), value.end()).size() < value.size()) {
    return false;
  }
  return std::all_of(value.begin(), value.end(),
                     [&](const Json& item) { return is_valid(schema.value("items", Json(true)), item); });
}

/// The part of JSON Schema that the schema uses; any other keyword is a failure.
bool is_valid(const Json& schema, const Json& value) {
  if (schema.is_boolean()) return schema.get<bool>();
  static const std::regex known(
      "\\$schema|title|description|default|type|enum|const|pattern|not|allOf|if|then|required|properties|"
      "propertyNames|additionalProperties|items|minItems|maxItems|uniqueItems|minimum|maximum|"
      "exclusiveMinimum|multipleOf");
  for (const auto& [keyword, rule] : schema.items()) EXPECT_TRUE(std::regex_match(keyword, known)) << keyword;

  if (schema.contains("type") && !has_type(value, schema["type"])) return false;
  if (schema.contains("const") && value != schema["const"]) return false;
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
    return false;
  }
  if (schema.contains("not") && is_valid(schema["not"], value)) return false;
  if (schema.contains("pattern") && value.is_string() &&
      !std::regex_search(value.get<std::string>(), std::regex(schema["pattern"].get<std::string>()))) {
    return false;
  }
  for (const Json& condition : schema.value("allOf", Json::array())) {
    if (is_valid(condition["if"], value) && !is_valid(condition["then"], value)) return false;
  }
  if (value.is_object()) return object_is_valid(schema, value);
  if (value.is_array()) return array_is_valid(schema, value);
  return !value.is_number() || number_is_valid(schema, value);
}

const Json& schema() {
  static const Json parsed = Json::parse(json_schema(fake_estimators()));
  return parsed;
}

Node parse_node(std::string_view text) {
  std::vector<Problem> problems;
  return parse_document(text, "f", problems).value_or(Node{});
}

TEST(JsonSchema, AcceptsEveryGalleryFileAndWhatItResolvesTo) {
  for (const std::string& name : test::gallery()) {
    std::vector<Problem> problems;
    const auto file = read_document(test::gallery_file(name), problems);
    ASSERT_TRUE(file) << test::text_of(problems);
    EXPECT_TRUE(is_valid(schema(), to_json(*file))) << name;
    const LoadResult result = load_world(test::gallery_file(name), {}, fake_estimators(), "1.0");
    EXPECT_TRUE(is_valid(schema(), to_json(parse_node(result.resolved)))) << name;
  }
}

/// Calls visit(node) for every value of a tree; visit may change the tree, but must undo the change.
void for_each_node(Node& node, const std::function<void(Node&)>& visit) {
  for (Node& item : node.items) for_each_node(item, visit);
  for (Node::Entry& entry : node.entries) for_each_node(entry.value, visit);
  visit(node);
}

/// Mutates every value of one resolved file that has all kinds of sections. The loader and the schema must both
/// refuse each mutant.
class BothRefuse : public testing::Test {
 protected:
  void SetUp() override {
    root_ = parse_node(
        "robot: {start: {x_m: -8, y_m: -8}}\n"
        "physics: {patches: [{min_m: [0, 0], max_m: [1, 1]}]}\n"
        "landmarks: {placed: [{x_m: 1, y_m: 1}], generators: [{type: ring, count: 3}, {type: grid, cell_m: "
        "[20, 20]},\n"
        "  {type: clusters, count: 3}, {type: corridor, points_m: [[1, 5], [5, 5]]}]}\n"
        "obstacles: {boxes: [{x_m: 9, y_m: 9, size_m: [1, 1]}], walls: [{points_m: [[-15, 12], [15, 12]]}]}\n"
        "drive: {mode: waypoints, waypoints_m: [[-8, -8], [8, -8]]}\n"
        "estimators: {ekf: {}, seif_report: {}, mine: {type: seif_report, K: 3}}\n"
        "film: {estimators: [mine]}\n");
    const LoadResult result = load();
    ASSERT_TRUE(result.world) << test::text_of(result.problems);
    root_ = parse_node(result.resolved);
  }

  LoadResult load() { return test::load_text(folder_, emit(root_)); }

  void expect_both_refuse() {
    EXPECT_FALSE(load().world) << emit(root_);
    EXPECT_FALSE(is_valid(schema(), to_json(root_))) << emit(root_);
  }

  Folder folder_;
  Node root_;
};

TEST_F(BothRefuse, UnknownKeysInEveryMap) {
  for_each_node(root_, [&](Node& node) {
    if (node.kind != Node::Kind::map) return;
    const bool is_names = &node == root_.find("estimators");
    node.entries.push_back({is_names ? "no name" : "surprise", {}, parse_node("{}")});
    expect_both_refuse();
    node.entries.pop_back();
  });
}

TEST_F(BothRefuse, ValuesOfAnotherType) {
  for_each_node(root_, [&](Node& node) {
    const bool is_word = node.kind == Node::Kind::scalar && to_json(node).is_string();
    Node changed = parse_node(is_word ? "5" : "\"word\"");
    std::swap(node, changed);
    expect_both_refuse();
    std::swap(node, changed);
  });
}

TEST_F(BothRefuse, Nothing) {
  for_each_node(root_, [&](Node& node) {
    Node changed;
    std::swap(node, changed);
    expect_both_refuse();
    std::swap(node, changed);
  });
}

TEST(JsonSchema, AgreesWithTheLoaderOnSingleMistakes) {
  const std::vector<std::string> mistakes = {
      "duration_s: 0",
      "duration_s: -5",
      "seed: -1",
      "seed: 1.5",
      "ground: {size_m: [1]}",
      "ground: {size_m: [10, 10, 10]}",
      "ground: {size_m: [0, 10]}",
      "robot: {wheel_radius_m: 0}",
      "physics: {friction: -0.1}",
      "physics: {engine: magic}",
      "physics: {step_rate_hz: 240.5}",
      "sensors: {landmark_sensor: {range_sd_m: 0}}",
      "sensors: {landmark_sensor: {bearing_sd_deg: -1}}",
      "sensors: {landmark_sensor: {fov_deg: 361}}",
      "sensors: {landmark_sensor: {max_range_m: 0}}",
      "sensors: {landmark_sensor: {miss_probability: 1.1}}",
      "sensors: {encoders: {distance_sd_m_per_sqrt_m: -1}}",
      "start_estimate: {x_sd_m: 0}",
      "scoring: {landmark_sample: 0}",
      "drive: {mode: fly}",
      "drive: {mode: waypoints}",
      "drive: {mode: loop, waypoints_m: [[0, 0], [1, 1]], file: x.csv}",
      "drive: {speed_m_s: 1}",
      "drive: {mode: commands}",
      "landmarks: {placed: [{x_m: 1}]}",
      "landmarks: {generators: [{count: 5}]}",
      "landmarks: {generators: [{type: ring}]}",
      "landmarks: {generators: [{type: ring, count: 5, region: {}}]}",
      "landmarks: {generators: [{type: uniform, count: 0}]}",
      "estimators: {truth: {type: ekf}}",
      "estimators: {odometry: {type: ekf}}",
      "estimators: {'a/b': {type: ekf}}",
      "estimators: {mine: {}}",
      "estimators: {mine: {type: nobody}}",
      "estimators: {ekf: {theta_x: 3}}",
      "estimators: {ekf: {odometry_sd_factor: 0}}",
      "estimators: {mine: {type: ekf, K: 3}}",
      "estimators: {seif_report: {theta_x: 0}}",
      "estimators: {seif_report: {theta_x: six}}",
      "faults: [{at_s: 1}]",
      "faults: [{kind: outlier, at_s: 1}]",
      "faults: [{kind: outlier, at_s: 1, size_sigma: big}]",
      "faults: [{kind: silence, at_s: 1, sensor: radar, duration_s: 1}]",
      "faults: [{kind: kidnapping, at_s: -1, x_m: 0, y_m: 0}]",
      "film: {size_px: [1280, 721]}",
      "film: {size_px: [62, 720]}",
      "film: {size_px: [1280, 7682]}",
      "film: {size_px: [1280]}",
      "film: {fps: 0}",
      "film: {fps: 241}",
      "film: {fps: 29.97}",
      "film: {speed: -1}",
      "film: {camera: above}",
      "film: {eye_m: [1, 2]}",
      "film: {target_m: [1, 2, 1e6]}",
      "film: {layers: {rays: 1}}",
      "film: {layers: {ray: true}}",
      "film: {estimators: ekf}",
      "film: {estimators: [a, b, c]}",
      "film: {estimators: [a, a]}",
      "film: {estimators: [a b]}",
  };
  const Folder folder;
  for (const std::string& text : mistakes) {
    EXPECT_FALSE(test::load_text(folder, text).world) << text;
    EXPECT_FALSE(is_valid(schema(), to_json(parse_node(text)))) << text;
  }
}

}  // namespace
}  // namespace worlds
