#include "harness/team/team_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/files/text_table.hpp"
#include "harness/score/scoreboard.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

Json exchange_json(const ExchangeSummary& exchanged, const TeamResult& result) {
  const seif::TeamCounts& counts = exchanged.counts;
  Json json{{"sent_bytes", exchanged.sent_bytes},    {"told_pieces", counts.told_pieces},
            {"told_bytes", counts.told_bytes},       {"heard_pieces", counts.heard_pieces},
            {"learnt_pieces", counts.learnt_pieces}, {"joined_s", Json::object()}};
  for (std::size_t i = 0; i < counts.joined_t.size(); ++i) {
    if (counts.joined_t[i] >= 0.0) json["joined_s"][result.robots[i].name] = counts.joined_t[i];
  }
  return json;
}

/// Whose news have come into a robot's map, and when the first of each.
std::string joined_cell(const seif::TeamCounts& counts, const TeamResult& result) {
  std::string cell;
  for (std::size_t i = 0; i < counts.joined_t.size(); ++i) {
    if (!(counts.joined_t[i] >= 0.0)) continue;
    cell += fmt::format("{}{} {:.0f} s", cell.empty() ? "" : ", ", result.robots[i].name, counts.joined_t[i]);
  }
  return cell.empty() ? "-" : cell;
}

/// Empty if the estimators exchange nothing.
std::string exchange_table(const TeamResult& result) {
  std::vector<TextRow> rows = {{"robot", "estimator", "sent [kB]", "told", "heard", "learnt", "joined"}};
  for (const TeamResult::Robot& robot : result.robots) {
    for (const ExchangeSummary& exchanged : robot.exchanged) {
      const seif::TeamCounts& counts = exchanged.counts;
      rows.push_back({robot.name, exchanged.estimator,
                      number_cell(1e-3 * static_cast<double>(exchanged.sent_bytes), 1),
                      std::to_string(counts.told_pieces), std::to_string(counts.heard_pieces),
                      std::to_string(counts.learnt_pieces), joined_cell(counts, result)});
    }
  }
  return rows.size() == 1 ? "" : '\n' + text_table(rows);
}

bool is_whole(const TeamResult& result) {
  return !result.interrupted &&
         std::ranges::all_of(result.robots, [](const auto& robot) { return robot.run.error.empty(); });
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
  for (const TeamResult::Robot& robot : result.robots) {
    Json& to = json["robots"][robot.name] = Json::parse(to_json(robot.run.summary));
    for (const ExchangeSummary& exchanged : robot.exchanged)
      to["exchange"][exchanged.estimator] = exchange_json(exchanged, result);
  }
  constexpr int indent = 2;
  return json.dump(indent) + '\n';
}

std::string scoreboard(const TeamResult& result) {
  std::string text;
  for (const TeamResult::Robot& robot : result.robots)
    text +=
        fmt::format("{}robot {}\n{}", text.empty() ? "" : "\n", robot.name, scoreboard(robot.run.summary));
  return text + exchange_table(result);
}

bool is_part_of_a_run(const std::filesystem::path& summary) {
  try {
    return Json::parse(read_whole_file(summary)).at("interrupted").get<bool>();
  } catch (const Json::exception& error) {
    throw BadInput(fmt::format("{}: is no summary of a team: {}", summary.string(), error.what()));
  }
}

}  // namespace harness
