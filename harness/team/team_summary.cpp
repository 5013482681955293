#include "harness/team/team_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/score/scoreboard.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

bool is_whole(const TeamResult& result) {
  return !result.interrupted &&
         std::ranges::all_of(result.robots, [](const auto& robot) { return robot.second.error.empty(); });
}

}  // namespace

std::string to_json(const TeamResult& result) {
  Json json;
  json["world"] = result.world;
  json["seed"] = result.seed;
  json["version"] = program_version();
  json["interrupted"] = !is_whole(result);
  json["realtime_factor"] =
      std::isfinite(result.realtime_factor) ? Json(result.realtime_factor) : Json(nullptr);
  for (const auto& [name, robot] : result.robots) json["robots"][name] = Json::parse(to_json(robot.summary));
  constexpr int indent = 2;
  return json.dump(indent) + '\n';
}

std::string scoreboard(const TeamResult& result) {
  std::string text;
  for (const auto& [name, robot] : result.robots)
    text += fmt::format("{}robot {}\n{}", text.empty() ? "" : "\n", name, scoreboard(robot.summary));
  return text;
}

bool is_part_of_a_run(const std::filesystem::path& summary) {
  try {
    return Json::parse(read_whole_file(summary)).at("interrupted").get<bool>();
  } catch (const Json::exception& error) {
    throw BadInput(fmt::format("{}: is no summary of a team: {}", summary.string(), error.what()));
  }
}

}  // namespace harness
