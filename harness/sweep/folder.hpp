// The folder of a sweep: its plan, its world, its cells, and the tables that come of them. The files are
// those of docs/sweeps.md.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/sweep/cells.hpp"
#include "harness/sweep/plan.hpp"

namespace harness {

struct SweepFolder {
  std::filesystem::path path;  // absolute
  SweepPlan plan;

  std::filesystem::path world() const { return path / "world.yaml"; }
  CellFolder cells() const { return CellFolder(path / "cells"); }
  std::vector<CellState> states() const { return cells().states(cell_count(plan)); }
};

/// Opens the folder of a sweep. Throws BadInput if it is not one.
SweepFolder open_sweep(const std::filesystem::path& folder);

/// Begins a sweep, or goes on with one that is the same; several processes may do so at once. `write_world`
/// puts world.yaml, and what that needs, into the folder that it is told. The new folder is there with all of
/// this or not at all. Throws BadInput if the folder is there and holds anything else.
SweepFolder begin_sweep(const std::filesystem::path& folder, const SweepPlan& plan,
                        const std::function<void(const std::filesystem::path&)>& write_world);

/// Throws BadInput if the two are not parts of one sweep.
void check_same_sweep(const SweepFolder& theirs, const SweepFolder& ours);

/// Removes the remains of killed processes. No other process may work on the folder.
void remove_unfinished(const SweepFolder& sweep);

/// Copies world.yaml and what it needs.
void copy_world(const SweepFolder& from, const std::filesystem::path& to);

}  // namespace harness
