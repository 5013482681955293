#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "worlds/fields.hpp"
#include "worlds/names.hpp"
#include "worlds/suggestion.hpp"

namespace worlds {
namespace {

std::string format_number(double value) { return fmt::format("{}", value); }

enum class NumberStatus { good, no_number, not_finite };

/// A number in the syntax of YAML. Quoted text is not a number.
NumberStatus parse_number(const Node& node, double& value) {
  static const std::set<std::string, std::less<>> not_finite = {
      "inf", "+inf", "-inf", ".inf", "+.inf", "-.inf", "nan", ".nan", ".Inf", "-.Inf", ".NaN", "NaN"};
  if (node.kind != Node::Kind::scalar || node.quoted || node.text.empty()) return NumberStatus::no_number;
  if (not_finite.count(node.text) > 0) return NumberStatus::not_finite;
  std::string_view text = node.text;
  if (text.front() == '+') {
    text.remove_prefix(1);  // from_chars takes a minus sign but no plus sign
    if (text.empty() || text.front() == '+' || text.front() == '-') return NumberStatus::no_number;
  }
  if (text.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return NumberStatus::no_number;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) return NumberStatus::not_finite;
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole ? NumberStatus::good : NumberStatus::no_number;
}

std::string describe_range(const Range& range, std::string_view unit) {
  const std::string_view space = unit.empty() ? "" : " ";
  const std::string_view least = range.excludes_min ? "more than" : "at least";
  if (range.multiple_of > 0) {
    Range bounds = range;
    bounds.multiple_of = 0.0;
    return fmt::format("a multiple of {}, {}", range.multiple_of, describe_range(bounds, unit));
  }
  if (range.min <= -largest_number) return fmt::format("at most {}{}{}", show_bound(range.max), space, unit);
  if (range.max == largest_number) return fmt::format("{} {}{}{}", least, range.min, space, unit);
  return fmt::format("{} {} and at most {}{}{}", least, range.min, show_bound(range.max), space, unit);
}

bool contains(const Range& range, double value) {
  if (range.multiple_of > 0 && std::fmod(value, range.multiple_of) != 0.0) return false;
  return value <= range.max && (range.excludes_min ? value > range.min : value >= range.min);
}

/// The beginning of a text, for messages.
std::string shown(const std::string& text) {
  constexpr std::size_t longest = 40;
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

/// Whether a text holds a control character that is no line end and no tab. Such a text could not be read back
/// from the files of a run.
bool has_control_character(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto code = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : ' ');
    if ((code < 0x20 && code != '\n' && code != '\t') || code == 0x7F) return true;
    if (code == 0xC2 && next >= 0x80 && next < 0xA0) return true;  // U+0080 to U+009F
  }
  return false;
}

/// Describes a value, for messages.
std::string describe_node(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return "nothing";
    case Node::Kind::sequence:
      return "a list";
    case Node::Kind::map:
      return "a map";
    case Node::Kind::scalar:
      break;
  }
  return node.quoted ? fmt::format("the quoted text \"{}\"", shown(node.text))
                     : fmt::format("'{}'", shown(node.text));
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

Node make_scalar(std::string text, bool quoted, const Location& where) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.text = std::move(text);
  node.quoted = quoted;
  node.where = where;
  return node;
}

Node make_empty(Node::Kind kind, const Location& where) {
  Node node;
  node.kind = kind;
  node.where = where;
  return node;
}

template <int N>
Node make_point(const Eigen::Vector<double, N>& point, const Location& where) {
  Node node = make_empty(Node::Kind::sequence, where);
  for (const double value : point) node.items.push_back(make_scalar(format_number(value), false, where));
  return node;
}

/// Collects the keys that a description asks for, and does nothing else.
class KeyCollector : public Fields {
 public:
  std::vector<std::string> keys;

  void section(std::string_view key, std::string_view, const std::function<void(Fields&)>&) override {
    add(key);
  }
  void named(std::string_view key, const NameRule&, std::string_view,
             const std::function<void(Fields&, const std::string&)>&) override {
    add(key);
  }
  void variant(std::string_view key, std::string&, const std::vector<Case>& cases, std::string_view,
               Need) override {
    add(key);
    for (const Case& one : cases) one.describe(*this);
  }
  bool sound() const override { return false; }
  void problem(std::string_view, std::string) override {}

 protected:
  void field(const FieldSpec& spec, Value) override { add(spec.key); }
  void list_of_maps(std::string_view key, std::string_view, const std::function<void(std::size_t)>&,
                    const std::function<void(Fields&, std::size_t)>&) override {
    add(key);
  }

 private:
  void add(std::string_view key) { keys.emplace_back(key); }
};

/// Reads one map; each inner map has its own reader.
class Reader : public Fields {
 public:
  Reader(Node& map, std::string path, std::string_view unit, std::vector<Problem>& problems)
      : map_(map),
        path_(std::move(path)),
        unit_(unit),
        problems_(problems),
        problems_before_(problems.size()) {}

  /// To be called after all keys have been described.
  void refuse_unknown_keys() {
    if (accepts_unknown_keys_) return;
    const std::vector<std::string> known(known_.begin(), known_.end());
    for (const Node::Entry& entry : map_.entries) {
      if (known_.count(entry.key) > 0) continue;
      const auto foreign = foreign_.find(entry.key);
      const std::string message = foreign == foreign_.end() ? fmt::format("unknown key '{}'{}", entry.key,
                                                                          suggestion(entry.key, known))
                                                            : foreign->second;
      problems_.push_back({entry.where, message, path_of(entry.key)});
    }
  }

  void section(std::string_view key, std::string_view,
               const std::function<void(Fields&)>& describe) override {
    Node& child = child_of_kind(key, Node::Kind::map);
    if (child.kind == Node::Kind::map) read_map(child, path_of(key), key, describe);
  }

  void named(std::string_view key, const NameRule& rule, std::string_view,
             const std::function<void(Fields&, const std::string&)>& describe) override {
    Node& child = child_of_kind(key, Node::Kind::map);
    for (Node::Entry& entry : child.entries) {
      const std::string path = path_of(key) + '.' + entry.key;
      const bool reserved =
          std::find(rule.reserved.begin(), rule.reserved.end(), entry.key) != rule.reserved.end();
      if (reserved) {
        problems_.push_back({entry.where, fmt::format("the name '{}' is taken", entry.key), path});
      } else if (!is_name(entry.key)) {
        problems_.push_back(
            {entry.where, fmt::format("'{}' is no name: use {}", shown(entry.key), name_alphabet()), path});
      } else if (expect_kind(entry.value, Node::Kind::map, path, entry.key)) {
        read_map(entry.value, path, "", [&](Fields& fields) { describe(fields, entry.key); });
      }
    }
  }

  void variant(std::string_view key, std::string& kind, const std::vector<Case>& cases, std::string_view help,
               Need need) override {
    std::vector<std::string> names;
    for (const Case& one : cases) names.push_back(one.name);
    const std::size_t problems_before = problems_.size();
    choice(key, kind, names, help, need);
    const bool known_kind = problems_.size() == problems_before;
    const Case* chosen = nullptr;
    for (const Case& one : cases) {
      if (known_kind && one.name == kind) {
        chosen = &one;
        continue;
      }
      KeyCollector collector;
      one.describe(collector);
      for (const std::string& name : collector.keys) {
        if (known_kind) {
          std::string& message = foreign_[name];
          message += message.empty() ? fmt::format("'{}' does not belong to {} '{}', but to '{}'", name, key,
                                                   kind, one.name)
                                     : fmt::format(", '{}'", one.name);
        } else {
          known_.insert(name);  // it is not yet known whether this key belongs here
        }
      }
    }
    if (chosen != nullptr) chosen->describe(*this);
  }

  bool sound() const override { return problems_.size() == problems_before_; }

  void problem(std::string_view key, std::string message) override {
    const Node* node = key.empty() ? &map_ : map_.find(key);
    problems_.push_back(
        {node != nullptr ? node->where : map_.where, std::move(message), key.empty() ? path_ : path_of(key)});
  }

  void accept_unknown_keys() override { accepts_unknown_keys_ = true; }

 protected:
  void field(const FieldSpec& spec, Value value) override {
    known_.insert(std::string(spec.key));
    Node* node = map_.find(spec.key);
    if (node != nullptr) {
      std::visit([&](auto* target) { read(*node, path_of(spec.key), spec, *target); }, value);
    } else if (spec.need == Need::required) {
      problems_.push_back({map_.where, fmt::format("the key '{}' is missing", spec.key), path_of(spec.key)});
    } else if (spec.need == Need::defaulted) {
      add_entry(spec.key, std::visit([&](auto* target) { return write(*target); }, value));
    }
  }

  void list_of_maps(std::string_view key, std::string_view, const std::function<void(std::size_t)>& resize,
                    const std::function<void(Fields&, std::size_t)>& describe) override {
    Node& child = child_of_kind(key, Node::Kind::sequence);
    resize(child.items.size());
    for (std::size_t i = 0; i < child.items.size(); ++i) {
      const std::string path = fmt::format("{}.{}", path_of(key), i);
      if (!expect_kind(child.items[i], Node::Kind::map, path, key)) continue;
      read_map(child.items[i], path, "", [&](Fields& fields) { describe(fields, i); });
    }
  }

 private:
  void read_map(Node& node, const std::string& path, std::string_view key,
                const std::function<void(Fields&)>& describe) {
    Reader reader(node, path, unit_of_key(key), problems_);
    describe(reader);
    reader.refuse_unknown_keys();
  }

  std::string path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
  }

  std::string_view unit(std::string_view key) const {
    const std::string_view own = unit_of_key(key);
    return own.empty() ? unit_ : own;
  }

  Node& add_entry(std::string_view key, Node value) {
    map_.entries.push_back({std::string(key), map_.where, std::move(value)});
    return map_.entries.back().value;
  }

  /// The map or list of a key; a missing one is made, empty. A value of another kind is a problem.
  Node& child_of_kind(std::string_view key, Node::Kind kind) {
    known_.insert(std::string(key));
    Node* child = map_.find(key);
    if (child == nullptr) return add_entry(key, make_empty(kind, map_.where));
    expect_kind(*child, kind, path_of(key), key);
    return *child;
  }

  bool expect_kind(const Node& node, Node::Kind kind, const std::string& path, std::string_view what) {
    if (node.kind == kind) return true;
    const char* const expected = kind == Node::Kind::map ? "a map" : "a list";
    problems_.push_back(
        {node.where, fmt::format("'{}' must be {}, not {}", what, expected, describe_node(node)), path});
    return false;
  }

  void refuse(const Node& node, const std::string& path, const FieldSpec& spec, std::string_view expected) {
    problems_.push_back(
        {node.where, fmt::format("'{}' must be {}, not {}", spec.key, expected, describe_node(node)), path});
  }

  void read(const Node& node, const std::string& path, const FieldSpec& spec, double& target) {
    double value = 0.0;
    const NumberStatus status = parse_number(node, value);
    if (status == NumberStatus::no_number) return refuse(node, path, spec, "a number");
    if (status == NumberStatus::not_finite) return refuse(node, path, spec, "a finite number");
    if (!contains(spec.range, value)) {
      return refuse(node, path, spec, describe_range(spec.range, unit(spec.key)));
    }
    target = value;
  }

  void read(const Node& node, const std::string& path, const FieldSpec& spec, std::int64_t& target) {
    double number = 0.0;
    const NumberStatus status = parse_number(node, number);
    if (status == NumberStatus::no_number) return refuse(node, path, spec, "a number");
    std::int64_t value = 0;
    const char* const end = node.text.data() + node.text.size();
    const auto [stop, error] = std::from_chars(node.text.data(), end, value);
    if (error == std::errc::result_out_of_range)
      return refuse(node, path, spec, describe_range(spec.range, unit(spec.key)));
    if (error != std::errc() || stop != end) return refuse(node, path, spec, "a whole number");
    if (!contains(spec.range, static_cast<double>(value))) {
      return refuse(node, path, spec, describe_range(spec.range, unit(spec.key)));
    }
    target = value;
  }

  void read(const Node& node, const std::string& path, const FieldSpec& spec, bool& target) {
    const bool is_true = node.kind == Node::Kind::scalar && !node.quoted && node.text == "true";
    const bool is_false = node.kind == Node::Kind::scalar && !node.quoted && node.text == "false";
    if (!is_true && !is_false) return refuse(node, path, spec, "true or false");
    target = is_true;
  }

  void read(const Node& node, const std::string& path, const FieldSpec& spec, std::string& target) {
    double number = 0.0;
    const bool is_word = node.quoted || (parse_number(node, number) == NumberStatus::no_number &&
                                         node.text != "true" && node.text != "false");
    if (node.kind != Node::Kind::scalar || !is_word) {
      return refuse(node, path, spec,
                    node.kind == Node::Kind::scalar ? "a text (put it in quotes)" : "a text");
    }
    if (has_control_character(node.text))
      return refuse(node, path, spec, "a text without control characters");
    const auto& choices = spec.choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), node.text) == choices.end()) {
      problems_.push_back({node.where,
                           fmt::format("'{}' must be one of {}, not '{}'{}", spec.key, join(choices),
                                       node.text, suggestion(node.text, choices)),
                           path});
      return;
    }
    target = node.text;
  }

  template <int N>
  void read(const Node& node, const std::string& path, const FieldSpec& spec,
            Eigen::Vector<double, N>& target) {
    if (node.kind != Node::Kind::sequence || node.items.size() != N) {
      return refuse(node, path, spec, N == 2 ? "a pair [x, y]" : "a triple [x, y, z]");
    }
    const std::size_t before = problems_.size();
    Eigen::Vector<double, N> value = Eigen::Vector<double, N>::Zero();
    for (int i = 0; i < N; ++i) {
      read(node.items[static_cast<std::size_t>(i)], fmt::format("{}.{}", path, i), spec, value[i]);
    }
    if (problems_.size() == before) target = value;
  }

  void read(const Node& node, const std::string& path, const FieldSpec& spec,
            std::vector<Eigen::Vector2d>& target) {
    if (node.kind != Node::Kind::sequence) return refuse(node, path, spec, "a list of pairs [x, y]");
    if (node.items.size() < spec.min_count) {
      problems_.push_back({node.where,
                           fmt::format("'{}' must have at least {} points, not {}", spec.key, spec.min_count,
                                       node.items.size()),
                           path});
      return;
    }
    const std::size_t before = problems_.size();
    std::vector<Eigen::Vector2d> value(node.items.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
      read(node.items[i], fmt::format("{}.{}", path, i), spec, value[i]);
    }
    if (problems_.size() == before) target = std::move(value);
  }

  void read(const Node& node, const std::string& path, const FieldSpec& spec,
            std::vector<std::string>& target) {
    if (node.kind != Node::Kind::sequence) return refuse(node, path, spec, "a list of names");
    if (node.items.size() > spec.max_count) {
      problems_.push_back({node.where,
                           fmt::format("'{}' must have at most {} names, not {}", spec.key, spec.max_count,
                                       node.items.size()),
                           path});
      return;
    }
    const std::size_t before = problems_.size();
    std::vector<std::string> value(node.items.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
      const Node& item = node.items[i];
      const std::string item_path = fmt::format("{}.{}", path, i);
      read(item, item_path, spec, value[i]);
      const auto end = value.begin() + static_cast<std::ptrdiff_t>(i);
      if (item.kind == Node::Kind::scalar && !is_name(item.text)) {
        refuse(item, item_path, spec, "a list of names of " + name_alphabet());
      } else if (std::find(value.begin(), end, value[i]) != end && !value[i].empty()) {
        problems_.push_back({item.where, fmt::format("'{}' stands twice", item.text), item_path});
      }
    }
    if (problems_.size() == before) target = std::move(value);
  }

  Node write(double value) const { return make_scalar(format_number(value), false, map_.where); }
  Node write(std::int64_t value) const { return make_scalar(fmt::format("{}", value), false, map_.where); }
  Node write(bool value) const { return make_scalar(value ? "true" : "false", false, map_.where); }
  template <int N>
  Node write(const Eigen::Vector<double, N>& value) const {
    return make_point(value, map_.where);
  }

  Node write(const std::string& value) const {
    Node node = make_scalar(value, false, map_.where);
    double number = 0.0;
    node.quoted = parse_number(node, number) != NumberStatus::no_number || value == "true" ||
                  value == "false" || value == "null" || value == "~";
    return node;
  }

  Node write(const std::vector<Eigen::Vector2d>& value) const {
    Node node = make_empty(Node::Kind::sequence, map_.where);
    for (const Eigen::Vector2d& point : value) node.items.push_back(write(point));
    return node;
  }

  Node write(const std::vector<std::string>& value) const {
    Node node = make_empty(Node::Kind::sequence, map_.where);
    for (const std::string& name : value) node.items.push_back(write(name));
    return node;
  }

  Node& map_;
  std::string path_;
  std::string_view unit_;  // of keys without a unit of their own: the section's key tells it
  std::vector<Problem>& problems_;
  std::size_t problems_before_;
  bool accepts_unknown_keys_ = false;
  std::set<std::string, std::less<>> known_;
  std::map<std::string, std::string, std::less<>> foreign_;  // keys of this section's other kinds -> message
};

}  // namespace

bool read_fields(Node& document, const std::function<void(Fields&)>& describe,
                 std::vector<Problem>& problems) {
  if (document.kind != Node::Kind::map) {
    problems.push_back({document.where, "the document must be a map, not " + describe_node(document), ""});
    return false;
  }
  const std::size_t before = problems.size();
  Reader reader(document, "", "", problems);
  describe(reader);
  reader.refuse_unknown_keys();
  return problems.size() == before;
}

}  // namespace worlds
