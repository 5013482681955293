// The description of world files. The reader, the schema and the defaults all come from this one.
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
  double lane = 2.0;                                    // [m] between lanes, at most
};

/// The content of a world file, before paths are laid out, command files read and landmarks generated.
struct WorldFile {
  World world;
  std::vector<Generator> generators;
  SerpentineArea area;
  std::string version;  // of the program that resolved the file; empty for a file that is not resolved
};

/// Describes all sections of a world file.
void describe_world(Fields& fields, WorldFile& file, const EstimatorSchemas& estimators);

}  // namespace worlds
