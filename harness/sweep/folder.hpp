// The folder of a sweep: its plan, world, cells and tables. The files are described in docs/sweeps.md.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/files/file_lock.hpp"
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

/// Opens the folder of a sweep that was begun. Throws BadInput if it is not such a folder.
SweepFolder open_sweep(const std::filesystem::path& folder);

/// Begins a sweep, or continues the same sweep if it was begun. Several processes may do so at once.
/// `write_world` writes world.yaml, and the files that it needs, to the given folder. The new folder appears
/// with all of these or not at all. Throws BadInput if the folder exists and holds anything else.
SweepFolder begin_sweep(const std::filesystem::path& folder, const SweepPlan& plan,
                        const std::function<void(const std::filesystem::path&)>& write_world);

/// Throws BadInput if the two are not parts of one sweep.
void check_same_sweep(const SweepFolder& theirs, const SweepFolder& ours);

/// A lock on the sweep, to be held while its cells are run.
FileLock lock_of_sweep(const SweepFolder& sweep);

/// True if a process is running cells of the sweep.
bool is_going_on(const SweepFolder& sweep);

/// Removes what killed processes have left. No other process may work on the folder.
void remove_unfinished(const SweepFolder& sweep);

/// Copies world.yaml and the files that it needs.
void copy_world(const SweepFolder& from, const std::filesystem::path& to);

}  // namespace harness
