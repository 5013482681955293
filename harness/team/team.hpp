// Several robots in one world, ready to run: each with a stream and estimators of its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/run/prepared_run.hpp"
#include "harness/simulation/simulated_stream.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

struct TeamMember {
  std::string name;
  PreparedRun run;
  SimulatedStream* stream = nullptr;  // that of the run
};

struct Team {
  std::string world;
  std::uint64_t seed = 0;
  worlds::Radio radio;
  std::vector<TeamMember> members;  // in the order of the world
};

/// The world of one robot (worlds::world_of_robot), with random streams of its own: (seed, "robot/NAME").
worlds::World member_world(const worlds::World& world, std::size_t robot);

/// Throws what prepare_run() throws.
Team prepare_team(const worlds::World& world, const seif::Registry& registry);

/// Makes the folder of each member in `folder`, and enters it into the member's plan. Writes world.yaml, and to each
/// member's folder the settings with which its log can be replayed alone.
void open_team_folder(Team& team, const std::filesystem::path& folder, const worlds::World& world,
                      const std::string& resolved);

}  // namespace harness
