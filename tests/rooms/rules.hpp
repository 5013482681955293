// The architecture as rules on the text of the tree: who may use whom. Each check returns the violations, as
// `path:line: what is wrong`.
//
//   room                    may include                       and privately
//   seif                    seif, Eigen
//   worlds                  worlds, Eigen, fmt                yaml-cpp, nlohmann
//   sensors                 sensors, seif/types.hpp, Eigen
//   sim, but for render     sim, worlds, Eigen, fmt           Bullet
//   sim/render              sim/render, Eigen, fmt            OSMesa
//   harness/peers           harness/peers                     MRPT
//   harness                 everything                        nlohmann, CLI11
//
// A test of a room may include everything that the room may, and the files beside it by their bare names.
#pragma once

#include <string>
#include <vector>

#include "source.hpp"

namespace rooms {

using Findings = std::vector<std::string>;
inline const Findings no_findings;

/// Finds includes against the arrows, libraries and names that do not belong there, headers without a guard,
/// and sources of chance or time that are not passed in.
Findings check_source(const Source& source);

/// Finds libraries that a file gets through the headers of a room that should keep them private, and estimators
/// or simulators that the scorer can see.
Findings check_reach(const std::vector<Source>& sources);

/// Checks what a room's CMakeLists.txt builds and links.
Findings check_cmake_lists(const TextFile& file);

/// Finds entries that the architecture does not have, and files whose names tell no purpose.
Findings check_paths(const std::vector<std::string>& paths);

}  // namespace rooms
