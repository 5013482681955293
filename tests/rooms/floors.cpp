#include "floors.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace rooms {
namespace {

constexpr std::string_view harness = "harness/";
constexpr std::ptrdiff_t most_files_at_the_top = 5;

/// From the lowest floor up. CONTRIBUTING.md has the same picture.
constexpr std::array<std::array<std::string_view, 5>, 10> floors = {{
    {"files", "peers", "statistics", "terminal", "web"},
    {"figures", "stream"},
    {"readers", "recording", "simulation"},
    {"estimators", "score"},
    {"exports", "run"},
    {"comparison", "film", "stress", "team"},
    {"doctor", "paper", "sweep"},
    {"report"},
    {"live"},
    {"commands"},
}};

/// The sub-room of a file of harness/; empty for one at its top and for other files.
std::string_view sub_room_of(std::string_view path) {
  if (!path.starts_with(harness)) return {};
  path.remove_prefix(harness.size());
  const std::size_t end = path.find('/');
  return end == std::string_view::npos ? std::string_view{} : path.substr(0, end);
}

/// The floor of a sub-room, from 1; 0 for a sub-room without a floor.
std::ptrdiff_t floor_of(std::string_view sub_room) {
  const auto found = std::ranges::find_if(
      floors, [&](const auto& rooms) { return std::ranges::find(rooms, sub_room) != rooms.end(); });
  return sub_room.empty() || found == floors.end() ? 0 : found - floors.begin() + 1;
}

}  // namespace

Findings check_floors(const Source& source) {
  if (!source.path.starts_with(harness)) return {};
  const std::string_view from = sub_room_of(source.path);
  if (floor_of(from) == 0) return {source.path + ":1: is in no sub-room of harness/"};
  Findings findings;
  for (const Include& include : source.includes) {
    const std::string_view to = sub_room_of(include.name);
    const bool is_lower = floor_of(to) != 0 && floor_of(to) < floor_of(from);
    if (!include.name.starts_with(harness) || to == from || is_lower) continue;
    findings.push_back(source.path + ":" + std::to_string(include.line) + ": " + include.name +
                       " is not on a lower floor");
  }
  return findings;
}

Findings check_top_of_harness(const std::vector<std::string>& paths) {
  const auto at_the_top = std::ranges::count_if(
      paths, [](const std::string& path) { return path.starts_with(harness) && sub_room_of(path).empty(); });
  if (at_the_top <= most_files_at_the_top) return {};
  return {"harness: " + std::to_string(at_the_top) + " files stand at its top, at most " +
          std::to_string(most_files_at_the_top) + " may"};
}

}  // namespace rooms
