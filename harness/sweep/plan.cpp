#include "harness/sweep/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "harness/comparison/seeds.hpp"
#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse_axis(std::string_view text, const std::string& reason) {
  throw BadInput(
      fmt::format("--vary {}: {}; what is meant is like estimators.seif.theta_x=4,6,8", text, reason));
}

/// Reads the values of an axis: YAML, between commas.
class ValueSplitter {
 public:
  /// Splits at the commas that are not inside of brackets, braces or quotes. Empty if one of these is not
  /// closed.
  std::optional<std::vector<std::string>> split(std::string_view text) {
    for (at_ = 0; at_ < text.size(); ++at_) take(text);
    if (depth_ != 0 || quote_ != '\0') return std::nullopt;
    for (std::string& part : parts_) part = trimmed(part);
    return std::move(parts_);
  }

 private:
  void take(std::string_view text) {
    const char c = text[at_];
    if (c == ',' && depth_ == 0 && quote_ == '\0') {
      parts_.emplace_back();
      begins_ = true;
      return;
    }
    parts_.back() += c;
    if (quote_ != '\0') {
      take_quoted(text);
    } else if (begins_ && (c == '"' || c == '\'')) {
      quote_ = c;
    } else if ((begins_ || depth_ > 0) && (c == '[' || c == '{')) {
      ++depth_;
    } else if (depth_ > 0 && (c == ']' || c == '}')) {
      --depth_;
    }
    // A quote in the middle of a word, as in don't, is a letter.
    const bool separates = depth_ > 0 && (c == '[' || c == '{' || c == ',' || c == ':');
    begins_ = quote_ == '\0' && (separates || (begins_ && c == ' '));
  }

  void take_quoted(std::string_view text) {
    const bool has_next = at_ + 1 < text.size();
    const bool is_escape = quote_ == '"' && text[at_] == '\\' && has_next;
    const bool is_doubled = quote_ == '\'' && text[at_] == quote_ && has_next && text[at_ + 1] == quote_;
    if (is_escape || is_doubled) {
      parts_.back() += text[++at_];
    } else if (text[at_] == quote_) {
      quote_ = '\0';
    }
  }

  static std::string trimmed(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(' ');
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
  }

  std::vector<std::string> parts_{1};
  std::size_t at_ = 0;
  int depth_ = 0;       // of brackets and braces
  char quote_ = '\0';   // the quote that is open
  bool begins_ = true;  // a value begins here
};

/// True if a value at `inner` is part of the value at `outer`, or is that value.
bool is_inside(std::string_view inner, std::string_view outer) {
  return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '.');
}

std::string axes_text(const std::vector<SweepAxis>& axes) {
  std::string text;
  for (const SweepAxis& axis : axes)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", axis.path, fmt::join(axis.values, ","));
  return text.empty() ? "none" : text;
}

}  // namespace

SweepAxis parse_axis(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) refuse_axis(text, "has no path and values");
  const std::optional<std::vector<std::string>> values = ValueSplitter().split(text.substr(equals + 1));
  if (!values) refuse_axis(text, "a quote, a bracket or a brace is not closed");
  SweepAxis axis{std::string(text.substr(0, equals)), *values};
  for (auto value = axis.values.begin(); value != axis.values.end(); ++value) {
    if (value->empty()) refuse_axis(text, "a value is missing");
    if (std::find(axis.values.begin(), value, *value) != value)
      refuse_axis(text, fmt::format("'{}' stands twice", *value));
  }
  if (axis.path == "seed") refuse_axis(text, "seeds are varied by --seeds");
  return axis;
}

void check_plan(const SweepPlan& plan) {
  for (auto axis = plan.axes.begin(); axis != plan.axes.end(); ++axis) {
    for (auto earlier = plan.axes.begin(); earlier != axis; ++earlier) {
      if (earlier->path == axis->path) throw BadInput(fmt::format("--vary {}: stands twice", axis->path));
      if (is_inside(earlier->path, axis->path))
        throw BadInput(fmt::format("--vary {}: would have no effect, because --vary {} comes after it",
                                   earlier->path, axis->path));
    }
  }
  std::size_t count = plan.seeds.size();
  for (const SweepAxis& axis : plan.axes) {
    count *= axis.values.size();
    if (count > most_cells)
      throw BadInput(
          fmt::format("a sweep has at most {} cells, the product of seeds and values", most_cells));
  }
}

void check_overrides(const SweepPlan& plan, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides) {
    const std::string path = assignment.substr(0, assignment.find('='));
    if (path == "seed") throw BadInput(fmt::format("--set {}: seeds are given by --seeds", assignment));
    for (const SweepAxis& axis : plan.axes) {
      if (is_inside(path, axis.path))
        throw BadInput(fmt::format("--set {}: would have no effect, because --vary {} sets it in every run",
                                   assignment, axis.path));
    }
  }
}

std::size_t setting_count(const SweepPlan& plan) {
  std::size_t count = 1;
  for (const SweepAxis& axis : plan.axes) count *= axis.values.size();
  return count;
}

std::size_t cell_count(const SweepPlan& plan) { return setting_count(plan) * plan.seeds.size(); }

SweepCell cell_at(const SweepPlan& plan, std::size_t index) {
  return {index / plan.seeds.size(), plan.seeds.at(index % plan.seeds.size())};
}

std::vector<std::string> values_of(const SweepPlan& plan, std::size_t setting) {
  std::vector<std::string> values(plan.axes.size());
  for (std::size_t i = values.size(); i-- > 0;) {
    const std::vector<std::string>& all = plan.axes[i].values;
    values[i] = all[setting % all.size()];
    setting /= all.size();
  }
  return values;
}

std::vector<std::string> short_paths(const SweepPlan& plan) {
  const auto last_key = [](const SweepAxis& axis) { return axis.path.substr(axis.path.rfind('.') + 1); };
  std::vector<std::string> paths;
  for (const SweepAxis& axis : plan.axes) {
    const bool is_unique = std::ranges::count(plan.axes, last_key(axis), last_key) == 1;
    paths.push_back(is_unique ? last_key(axis) : axis.path);
  }
  return paths;
}

std::vector<std::string> overrides_of(const SweepPlan& plan, const SweepCell& cell) {
  const std::vector<std::string> values = values_of(plan, cell.setting);
  std::vector<std::string> overrides;
  for (std::size_t i = 0; i < values.size(); ++i)
    overrides.push_back(fmt::format("{}={}", plan.axes[i].path, values[i]));
  overrides.push_back(fmt::format("seed={}", cell.seed));
  return overrides;
}

std::string describe_cell(const SweepPlan& plan, std::size_t index) {
  return fmt::format("{}", fmt::join(overrides_of(plan, cell_at(plan, index)), " "));
}

std::string to_json(const SweepPlan& plan) {
  Json json;
  json["name"] = plan.name;
  json["version"] = plan.version;
  json["baseline"] = plan.baseline;
  json["seeds"] = seeds_text(plan.seeds);
  json["vary"] = Json::array();
  for (const SweepAxis& axis : plan.axes)
    json["vary"].push_back({{"path", axis.path}, {"values", axis.values}});
  return json.dump(2) + "\n";
}

SweepPlan plan_from_json(const std::string& text, const std::string& file) {
  try {
    const Json json = Json::parse(text);
    SweepPlan plan;
    plan.name = json.at("name");
    plan.version = json.at("version");
    plan.baseline = json.at("baseline");
    plan.seeds = parse_seeds(json.at("seeds").get<std::string>());
    for (const Json& axis : json.at("vary")) plan.axes.push_back({axis.at("path"), axis.at("values")});
    check_plan(plan);
    return plan;
  } catch (const Json::exception& error) {
    throw BadInput(fmt::format("{}: is no plan of a sweep: {}", file, error.what()));
  }
}

std::string difference_between(const SweepPlan& its, const SweepPlan& ours) {
  const auto differ = [](const char* what, const std::string& a, const std::string& b) {
    return fmt::format("its {} {}, and not {}", what, a, b);
  };
  if (its.name != ours.name) return differ("world is", its.name, ours.name);
  if (its.version != ours.version) return differ("program was", its.version, ours.version);
  if (its.seeds != ours.seeds) return differ("seeds are", seeds_text(its.seeds), seeds_text(ours.seeds));
  if (its.axes != ours.axes) return differ("varied values are", axes_text(its.axes), axes_text(ours.axes));
  return differ("baseline is", its.baseline, ours.baseline);
}

}  // namespace harness
