#include "worlds/schema.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "worlds/describe.hpp"

namespace worlds {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* name_pattern = "^[A-Za-z0-9_-]+$";

/// Writes the schema of one map; each inner map has its own writer.
class SchemaWriter : public Fields {
 public:
  explicit SchemaWriter(std::string_view unit) : unit_(unit) {}

  Json take() {
    Json schema = {
        {"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties_)}};
    if (!required_.empty()) schema["required"] = std::move(required_);
    if (!conditions_.empty()) schema["allOf"] = std::move(conditions_);
    return schema;
  }

  void section(std::string_view key, std::string_view help,
               const std::function<void(Fields&)>& describe) override {
    add(key, help, schema_of(key, describe));
  }

  void named(std::string_view key, const NameRule& rule, std::string_view help,
             const std::function<void(Fields&, const std::string&)>& describe) override {
    const auto describe_name = [&](const std::string& name) {
      return schema_of("", [&](Fields& fields) { describe(fields, name); });
    };
    Json schema = {{"type", "object"},
                   {"propertyNames", {{"pattern", name_pattern}, {"not", {{"enum", rule.reserved}}}}},
                   {"properties", Json::object()}};
    for (const std::string& name : rule.known) schema["properties"][name] = describe_name(name);
    schema["additionalProperties"] = describe_name("");
    add(key, help, std::move(schema));
  }

  void variant(std::string_view key, std::string& kind, const std::vector<Case>& cases, std::string_view help,
               Need need) override;

  bool sound() const override { return false; }
  void problem(std::string_view, std::string) override {}

 protected:
  void field(const FieldSpec& spec, Value value) override {
    Json schema = std::visit([&](auto* target) { return type_of(spec, *target); }, value);
    if (spec.need == Need::defaulted) {
      schema["default"] = std::visit([](auto* target) { return to_json(*target); }, value);
    }
    if (spec.need == Need::required) required_.push_back(spec.key);
    add(spec.key, spec.help, std::move(schema));
  }

  void list_of_maps(std::string_view key, std::string_view help,
                    const std::function<void(std::size_t)>& resize,
                    const std::function<void(Fields&, std::size_t)>& describe) override {
    resize(1);
    add(key, help,
        {{"type", "array"}, {"items", schema_of("", [&](Fields& fields) { describe(fields, 0); })}});
    resize(0);
  }

 private:
  static Json schema_of(std::string_view key, const std::function<void(Fields&)>& describe) {
    SchemaWriter writer(unit_of_key(key));
    describe(writer);
    return writer.take();
  }

  void add(std::string_view key, std::string_view help, Json schema) {
    const std::string_view own_unit = unit_of_key(key);
    const std::string_view unit = own_unit.empty() ? unit_ : own_unit;
    const bool is_measure =
        schema["type"] == "number" || schema["type"] == "integer" || schema["type"] == "array";
    std::string description(help);
    if (!unit.empty() && is_measure) description += " [" + std::string(unit) + "]";
    if (!description.empty()) schema["description"] = description;
    properties_[std::string(key)] = std::move(schema);
  }

  static Json number_type(const FieldSpec& spec, const char* type) {
    Json schema = {{"type", type}};
    if (std::isfinite(spec.range.min)) {
      schema[spec.range.excludes_min ? "exclusiveMinimum" : "minimum"] = spec.range.min;
    }
    constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
    if (spec.range.max >= static_cast<double>(largest) && std::string_view(type) == "integer") {
      schema["maximum"] = largest;
    } else if (std::isfinite(spec.range.max)) {
      schema["maximum"] = spec.range.max;
    }
    if (spec.range.multiple_of > 0) schema["multipleOf"] = spec.range.multiple_of;
    return schema;
  }

  template <int N>
  static Json type_of(const FieldSpec& spec, const Eigen::Vector<double, N>&) {
    return {{"type", "array"}, {"items", number_type(spec, "number")}, {"minItems", N}, {"maxItems", N}};
  }

  static Json type_of(const FieldSpec&, bool) { return {{"type", "boolean"}}; }
  static Json type_of(const FieldSpec& spec, std::int64_t) { return number_type(spec, "integer"); }
  static Json type_of(const FieldSpec& spec, double) { return number_type(spec, "number"); }
  static Json type_of(const FieldSpec& spec, const std::vector<Eigen::Vector2d>&) {
    return {{"type", "array"}, {"items", type_of(spec, Eigen::Vector2d())}, {"minItems", spec.min_count}};
  }
  static Json type_of(const FieldSpec& spec, const std::vector<std::string>&) {
    return {{"type", "array"},
            {"items", {{"type", "string"}, {"pattern", name_pattern}}},
            {"maxItems", spec.max_count},
            {"uniqueItems", true}};
  }
  static Json type_of(const FieldSpec& spec, const std::string&) {
    Json schema = {{"type", "string"}};
    if (!spec.choices.empty()) schema["enum"] = spec.choices;
    return schema;
  }

  template <int N>
  static Json to_json(const Eigen::Vector<double, N>& point) {
    return std::vector<double>(point.begin(), point.end());
  }
  static Json to_json(const std::vector<Eigen::Vector2d>& points) {
    Json list = Json::array();
    for (const Eigen::Vector2d& point : points) list.push_back(to_json(point));
    return list;
  }
  template <class T>
  static Json to_json(const T& value) {
    return value;
  }

  std::string_view unit_;
  Json properties_ = Json::object();
  Json required_ = Json::array();
  Json conditions_ = Json::array();
};

/// The keys of all kinds are properties. For each kind, a condition lists the keys that it does not have and
/// those that it requires.
void SchemaWriter::variant(std::string_view key, std::string& kind, const std::vector<Case>& cases,
                           std::string_view help, Need need) {
  std::vector<std::string> names;
  for (const Case& one : cases) names.push_back(one.name);
  choice(key, kind, names, help, need);
  std::vector<SchemaWriter> writers;
  for (const Case& one : cases) {
    SchemaWriter& writer = writers.emplace_back(unit_);
    one.describe(writer);
    for (const auto& [name, schema] : writer.properties_.items()) properties_[name] = schema;
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Json then = {{"properties", writers[i].properties_}};
    for (const SchemaWriter& other : writers) {
      for (const auto& [name, schema] : other.properties_.items()) {
        if (!writers[i].properties_.contains(name)) then["properties"][name] = false;
      }
    }
    if (!writers[i].required_.empty()) then["required"] = writers[i].required_;
    Json condition = {{"properties", {{std::string(key), {{"const", cases[i].name}}}}}};
    if (cases[i].name != kind)
      condition["required"] = Json::array({key});  // without the key, the default is used
    conditions_.push_back({{"if", std::move(condition)}, {"then", std::move(then)}});
  }
}

}  // namespace

std::string json_schema(const EstimatorSchemas& estimators) {
  WorldFile file;
  SchemaWriter writer("");
  describe_world(writer, file, estimators);
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "seifbed world file"}};
  schema.update(writer.take());
  schema["properties"]["extends"] = {
      {"type", "string"},
      {"description", "another world file, relative to this one, which this one changes"}};
  constexpr int indent = 2;
  return schema.dump(indent) + "\n";
}

}  // namespace worlds
