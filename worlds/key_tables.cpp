#include "worlds/key_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "worlds/describe.hpp"

namespace worlds {
namespace {

struct Row {
  std::string key;
  std::string type;
  std::string fallback;
  std::string meaning;
  std::vector<std::string> only_for = {};  // kinds with this key; empty: all
};

// The allowed values, in words.

std::string range_text(const Range& range) {
  std::string text;
  text += fmt::format(" {} {} and ≤ {}", range.excludes_min ? ">" : "≥", range.min, show_bound(range.max));
  if (range.multiple_of > 0) text += fmt::format(", a multiple of {}", range.multiple_of);
  return text;
}

std::string number_text(const FieldSpec& spec, std::string_view word) {
  return std::string(word) + range_text(spec.range);
}

std::string type_text(const FieldSpec&, bool) { return "`true` or `false`"; }
std::string type_text(const FieldSpec& spec, std::int64_t) { return number_text(spec, "integer"); }
std::string type_text(const FieldSpec& spec, double) { return number_text(spec, "number"); }
std::string type_text(const FieldSpec& spec, const std::string&) {
  return spec.choices.empty() ? "text" : fmt::format("`{}`", fmt::join(spec.choices, "`, `"));
}
std::string type_text(const FieldSpec& spec, const Eigen::Vector2d&) {
  return number_text(spec, "[x, y], numbers");
}
std::string type_text(const FieldSpec& spec, const Eigen::Vector3d&) {
  return number_text(spec, "[x, y, z], numbers");
}
std::string type_text(const FieldSpec& spec, const std::vector<Eigen::Vector2d>&) {
  return fmt::format("list of [x, y], at least {}", spec.min_count);
}
std::string type_text(const FieldSpec& spec, const std::vector<std::string>&) {
  return fmt::format("list of names, at most {}", spec.max_count);
}

std::string default_text(const std::string& value) { return value.empty() ? "" : fmt::format("`{}`", value); }
template <int N>
std::string default_text(const Eigen::Vector<double, N>& value) {
  return fmt::format("`[{}]`", fmt::join(value.begin(), value.end(), ", "));
}
std::string default_text(const std::vector<Eigen::Vector2d>& value) { return value.empty() ? "`[]`" : "…"; }
std::string default_text(const std::vector<std::string>& value) {
  return fmt::format("`[{}]`", fmt::join(value, ", "));
}
template <class T>
std::string default_text(const T& value) {
  return fmt::format("`{}`", value);
}

std::string sentence(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text.ends_with('.') ? text : text + '.';
}

/// A vertical bar would end the table cell, so it is escaped.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// Collects the rows of one section. The tables of inner sections follow as separate text.
class TableWriter : public Fields {
 public:
  TableWriter(std::string path, std::string help) : path_(std::move(path)), help_(std::move(help)) {}

  /// This section's table, and those of the sections inside of it.
  std::string text() const {
    std::string text = path_.empty() ? "## The top level\n\n" : fmt::format("## `{}`\n\n", path_);
    if (!help_.empty()) text += sentence(help_) + "\n\n";
    if (!rows_.empty()) text += table();
    return text + inner_;
  }

  void add(Row row) { rows_.push_back(std::move(row)); }

  void section(std::string_view key, std::string_view help,
               const std::function<void(Fields&)>& describe) override {
    add_inner(joined(key), help, describe);
  }

  void named(std::string_view key, const NameRule&, std::string_view help,
             const std::function<void(Fields&, const std::string&)>& describe) override {
    add_inner(joined(key) + ".NAME", help, [&](Fields& fields) { describe(fields, ""); });
  }

  void variant(std::string_view key, std::string& kind, const std::vector<Case>& cases, std::string_view help,
               Need need) override;

  bool sound() const override { return false; }
  void problem(std::string_view, std::string) override {}

 protected:
  void field(const FieldSpec& spec, Value value) override {
    Row row{.key = std::string(spec.key), .type = {}, .fallback = {}, .meaning = std::string(spec.help)};
    row.type = std::visit([&](auto* target) { return type_text(spec, *target); }, value);
    if (spec.need == Need::required) row.fallback = "*required*";
    if (spec.need == Need::defaulted)
      row.fallback = std::visit([](auto* target) { return default_text(*target); }, value);
    if (const std::string_view unit = unit_of_key(spec.key); !unit.empty())
      row.meaning += fmt::format(" [{}]", unit);
    rows_.push_back(std::move(row));
  }

  void list_of_maps(std::string_view key, std::string_view help,
                    const std::function<void(std::size_t)>& resize,
                    const std::function<void(Fields&, std::size_t)>& describe) override {
    resize(1);
    add_inner(joined(key) + "[]", help, [&](Fields& fields) { describe(fields, 0); });
    resize(0);
  }

 private:
  std::string joined(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
  }

  void add_inner(std::string path, std::string_view help, const std::function<void(Fields&)>& describe) {
    TableWriter writer(std::move(path), std::string(help));
    describe(writer);
    inner_ += writer.text();
  }

  std::string table() const {
    std::string text = "| key | value | default | meaning |\n|---|---|---|---|\n";
    for (const Row& row : rows_) {
      std::string meaning = row.meaning;
      if (!row.only_for.empty())
        meaning += fmt::format(" (only with `{}: {}`)", kind_key_, fmt::join(row.only_for, "`, `"));
      text += fmt::format("| `{}` | {} | {} | {} |\n", row.key, cell(row.type), cell(row.fallback),
                          cell(std::move(meaning)));
    }
    return text + '\n';
  }

  std::string path_;
  std::string help_;
  std::string kind_key_;
  std::vector<Row> rows_;
  std::string inner_;
};

/// A key that several kinds have gets one row, which names these kinds.
void TableWriter::variant(std::string_view key, std::string& kind, const std::vector<Case>& cases,
                          std::string_view help, Need need) {
  std::vector<std::string> names;
  std::string meaning(help);
  for (const Case& one : cases) {
    names.push_back(one.name);
    if (!one.help.empty()) meaning += fmt::format("; `{}`: {}", one.name, one.help);
  }
  choice(key, kind, names, meaning, need);
  kind_key_ = key;
  std::vector<Row> rows;
  std::map<std::string, std::string> inner;  // the same for all kinds that have it
  for (const Case& one : cases) {
    TableWriter writer(path_, "");
    one.describe(writer);
    for (Row& row : writer.rows_) {
      auto known = std::ranges::find(rows, row.key, &Row::key);
      if (known == rows.end()) known = rows.insert(rows.end(), std::move(row));
      known->only_for.push_back(one.name);
    }
    if (!writer.inner_.empty()) inner[writer.inner_] = one.name;
  }
  for (Row& row : rows) {
    if (row.only_for.size() == cases.size()) row.only_for.clear();
    rows_.push_back(std::move(row));
  }
  for (const auto& [text, _] : inner) inner_ += text;
}

/// An estimator schema without options for each type.
EstimatorSchemas without_options(const EstimatorSchemas& estimators) {
  EstimatorSchemas bare;
  for (const auto& [type, _] : estimators.types)
    bare.types[type] = [](Fields&, std::map<std::string, OptionValue>&) {};
  return bare;
}

}  // namespace

std::string key_tables(const EstimatorSchemas& estimators) {
  WorldFile file;
  TableWriter writer("", "");
  writer.add({.key = "extends",
              .type = "path",
              .fallback = "",
              .meaning = "another world file, relative to this one, which this one changes"});
  describe_world(writer, file, without_options(estimators));
  return writer.text();
}

}  // namespace worlds
