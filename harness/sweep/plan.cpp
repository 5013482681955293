#include "harness/sweep/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/comparison/seeds.hpp"
#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse_axis(std::string_view text, const std::string& reason) {
  throw BadInput(
      fmt::format("--vary {}: {}; what is meant is like estimators.seif.theta_x=4,6,8", text, reason));
}

/// Splits at the commas that are not inside brackets, braces or quotes.
std::vector<std::string> split_values(std::string_view text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = '\0';
  for (const char c : text) {
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      parts.emplace_back();
      continue;
    }
    parts.back() += c;
  }
  return parts;
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
  SweepAxis axis{std::string(text.substr(0, equals)), split_values(text.substr(equals + 1))};
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
    if (std::find_if(plan.axes.begin(), axis, [&](const SweepAxis& a) { return a.path == axis->path; }) !=
        axis)
      throw BadInput(fmt::format("--vary {}: stands twice", axis->path));
  }
  std::size_t count = plan.seeds.size();
  for (const SweepAxis& axis : plan.axes) {
    count *= axis.values.size();
    if (count > most_cells)
      throw BadInput(
          fmt::format("a sweep has at most {} cells, the product of seeds and values", most_cells));
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
