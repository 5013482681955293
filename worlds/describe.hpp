// The one description of world files.
#pragma once

#include <string>
#include <vector>

#include "worlds/generators.hpp"
#include "worlds/load.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// A rectangle to be covered in lanes.
struct SerpentineArea {
  Eigen::Vector2d min = Eigen::Vector2d::Constant(-5);  // [m]
  Eigen::Vector2d max = Eigen::Vector2d::Constant(5);   // [m]
  double lane = 2.0;                                    // [m] at most, from lane to lane
};

/// What a world file says, before paths are laid out, command files read and landmarks generated.
struct WorldFile {
  World world;
  std::vector<Generator> generators;
  SerpentineArea area;
  std::string version;  // of the program that resolved it; empty if none did
};

/// Describes all sections of a world file.
void describe_world(Fields& fields, WorldFile& file, const EstimatorSchemas& estimators);

}  // namespace worlds
