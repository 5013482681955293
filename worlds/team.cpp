#include "worlds/team.hpp"

#include "worlds/world.hpp"

namespace worlds {

World world_of_robot(const World& world, std::size_t robot) {
  const TeamRobot& member = world.robots.at(robot);
  World alone = world;
  alone.robots.clear();
  alone.robot.start = member.start;
  alone.drive = member.drive;
  alone.encoders = member.encoders;
  alone.landmark_sensor = member.landmark_sensor;
  alone.start_estimate = member.start_estimate;
  if (!member.estimators.empty()) alone.estimators = member.estimators;
  std::erase_if(alone.faults,
                [&](const Fault& fault) { return !fault.robot.empty() && fault.robot != member.name; });
  for (Fault& fault : alone.faults) fault.robot.clear();
  return alone;
}

std::vector<World> worlds_of_robots(const World& world) {
  if (world.robots.empty()) return {world};
  std::vector<World> alone;
  for (std::size_t i = 0; i < world.robots.size(); ++i) alone.push_back(world_of_robot(world, i));
  return alone;
}

}  // namespace worlds
