// Several robots in one world.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "worlds/drive.hpp"
#include "worlds/estimator_choice.hpp"
#include "worlds/placement.hpp"
#include "worlds/sensors.hpp"

namespace worlds {

struct World;

inline constexpr std::size_t most_robots_of_team = 64;  // [-]

/// One of several robots. They all have the body of World::robot.
struct TeamRobot {
  std::string name;  // that of its folder, too
  Placement start;
  Drive drive;
  Encoders encoders;
  LandmarkSensor landmark_sensor;
  StartEstimate start_estimate;
  std::vector<EstimatorChoice> estimators;  // empty: those of the world
};

/// The world as a lone robot of the team would find it: with its start, drive, sensors, estimators and faults, and
/// without the other robots.
World world_of_robot(const World& world, std::size_t robot);

/// The worlds of all robots; of a world without a team, itself alone.
std::vector<World> worlds_of_robots(const World& world);

}  // namespace worlds
