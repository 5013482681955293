// The results of a team's run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/run/run.hpp"
#include "harness/team/team_exchange.hpp"

namespace harness {

struct TeamResult {
  std::string world = {};
  std::uint64_t seed = 0;
  bool interrupted = false;      // by the user
  double realtime_factor = 0.0;  // [-] simulated time over real time
  struct Robot {
    std::string name;
    RunResult run;
    std::vector<ExchangeSummary> exchanged;
  };
  std::vector<Robot> robots = {};
};

/// The summary.json of a team: its own values, and the summaries of all robots by their names.
std::string to_json(const TeamResult& result);

/// The scoreboards of all robots, as text.
std::string scoreboard(const TeamResult& result);

/// Whether the summary.json of a team says that the run is not whole. Throws BadInput.
bool is_part_of_a_run(const std::filesystem::path& summary);

}  // namespace harness
