// The architecture as rules on the text of the tree: who may know whom. Each check returns what breaks a
// rule, as `path:line: what is wrong`.
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
// A test of a room may include what the room may, and by their bare names the files beside it.
#pragma once

#include <string>
#include <vector>

#include "source.hpp"

namespace rooms {

using Findings = std::vector<std::string>;
inline const Findings no_findings;

/// Includes against the arrows, libraries and names where they do not belong, unguarded headers, sources of
/// chance or time that nobody handed over.
Findings check_source(const Source& source);

/// Libraries that a file gets through the headers of a room that should have kept them to itself, and
/// estimators or simulators that the scorer gets to know.
Findings check_reach(const std::vector<Source>& sources);

/// What a room's CMakeLists.txt makes and links.
Findings check_cmake_lists(const TextFile& file);

/// Entries that are not among those of the architecture, and files without a purpose in their name.
Findings check_paths(const std::vector<std::string>& paths);

}  // namespace rooms
