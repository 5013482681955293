#include "harness/doctor/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

namespace harness {

namespace {

using Section = std::pair<const char*, const std::vector<Finding>*>;

std::array<Section, 3> sections_of(const Diagnosis& diagnosis) {
  return {{{"libraries", &diagnosis.libraries},
           {"machine", &diagnosis.machine},
           {"self_test", &diagnosis.self_test}}};
}

}  // namespace

Finding finding(const std::string& name, const std::function<std::string()>& look) {
  try {
    return {name, true, look()};
  } catch (const std::exception& error) {
    return {name, false, error.what()};
  }
}

bool is_well(const Diagnosis& diagnosis) {
  return std::ranges::all_of(sections_of(diagnosis), [](const Section& section) {
    return std::ranges::all_of(*section.second, &Finding::is_good);
  });
}

std::string diagnosis_board(const Diagnosis& diagnosis) {
  std::size_t width = 0;
  for (const auto& [title, findings] : sections_of(diagnosis)) {
    for (const Finding& found : *findings) width = std::max(width, found.name.size());
  }
  std::string text;
  std::ptrdiff_t bad = 0;
  for (const auto& [title, findings] : sections_of(diagnosis)) {
    if (!findings->empty()) text += fmt::format("{}\n", title);
    for (const Finding& found : *findings)
      text += fmt::format("  {:4}  {:{}}  {}\n", found.is_good ? "ok" : "BAD", found.name, width, found.says);
    bad += std::ranges::count(*findings, false, &Finding::is_good);
  }
  return text + (bad == 0 ? "All is well.\n" : fmt::format("{} of these need attention.\n", bad));
}

std::string to_json(const Diagnosis& diagnosis) {
  nlohmann::ordered_json json = {{"well", is_well(diagnosis)}};
  for (const auto& [title, findings] : sections_of(diagnosis)) {
    nlohmann::ordered_json& section = json[title] = nlohmann::ordered_json::object();
    for (const Finding& found : *findings)
      section[found.name] = {{"good", found.is_good}, {"says", found.says}};
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace harness
