#include "harness/team/team.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <utility>

#include "harness/files/output_file.hpp"
#include "harness/run/replay_settings.hpp"
#include "sensors/random_stream.hpp"
#include "sim/simulator.hpp"
#include "worlds/document.hpp"

namespace harness {

namespace {

/// What a replay of this robot's log asks for: the resolved world with the robot's own estimators and seed.
std::string settings_of_member(const std::string& resolved, std::size_t robot, std::uint64_t seed) {
  std::vector<worlds::Problem> problems;
  worlds::Node document = worlds::parse_document(resolved, "world.yaml", problems).value();
  const worlds::Node* own = worlds::find_path(document, fmt::format("robots.{}.estimators", robot));
  if (own != nullptr && !own->entries.empty()) *document.find("estimators") = worlds::Node(*own);
  document.find("seed")->text = std::to_string(seed);
  return settings_of_replay(worlds::emit(document));
}

}  // namespace

worlds::World member_world(const worlds::World& world, std::size_t robot) {
  worlds::World alone = worlds::world_of_robot(world, robot);
  constexpr int sign_bit = 1;  // seeds of world files have 63 bits
  alone.seed = sensors::random_stream(world.seed, "robot/" + world.robots[robot].name)() >> sign_bit;
  alone.name = fmt::format("{} {}", world.name, world.robots[robot].name);
  return alone;
}

Team prepare_team(const worlds::World& world, const seif::Registry& registry) {
  Team team{.world = world.name, .seed = world.seed, .radio = world.radio, .members = {}};
  std::vector<std::unique_ptr<sim::Simulator>> simulators = sim::make_team(world);
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    TeamMember& member = team.members.emplace_back();
    member.name = world.robots[i].name;
    member.run = prepare_run(member_world(world, i), registry, std::move(simulators[i]));
    member.stream = static_cast<SimulatedStream*>(member.run.stream.get());
  }
  return team;
}

void open_team_folder(Team& team, const std::filesystem::path& folder, const worlds::World& world,
                      const std::string& resolved) {
  write_world(folder, world, resolved);
  for (std::size_t i = 0; i < team.members.size(); ++i) {
    RunPlan& plan = team.members[i].run.plan;
    plan.folder = folder / team.members[i].name;
    std::filesystem::create_directory(plan.folder);
    write_whole_file(plan.folder / "replay.yaml", settings_of_member(resolved, i, plan.seed));
  }
}

}  // namespace harness
