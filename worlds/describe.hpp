// The description of world files. The reader, the schema and the defaults all come from this one.
#pragma once

#include <string>
#include <vector>

#include "worlds/describe_drive.hpp"
#include "worlds/generators.hpp"
#include "worlds/load.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// A robot of a team, before its path is laid out and its command files are read.
struct TeamRobotFile {
  TeamRobot robot;
  SerpentineArea area;
};

/// The content of a world file, before paths are laid out, command files read and landmarks generated.
struct WorldFile {
  World world;
  std::vector<Generator> generators;
  SerpentineArea area;
  std::vector<TeamRobotFile> robots;  // World::robots gets them once their drives are complete
  std::string version;  // of the program that resolved the file; empty for a file that is not resolved
};

/// Describes all sections of a world file.
void describe_world(Fields& fields, WorldFile& file, const EstimatorSchemas& estimators);

}  // namespace worlds
