// Sweeps: many runs of a world in separate processes. Finished runs are not repeated.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/sweep/aggregate.hpp"
#include "harness/sweep/folder.hpp"
#include "seif/registry.hpp"
#include "worlds/document.hpp"

namespace harness {

/// Every `of`-th cell, from the `number`-th, 1-based.
struct Shard {
  std::size_t number = 1;
  std::size_t of = 1;
};

/// Reads "3/16". Throws BadInput.
Shard parse_shard(std::string_view text);

/// The choices of a command line for a sweep.
struct SweepChoices {
  std::filesystem::path world;
  std::string seeds;
  std::vector<std::string> axes;       // path=v1,v2,..
  std::vector<std::string> overrides;  // path.to.key=value, of all runs
  std::string baseline;                // empty: the ekf, or the first
};

/// A sweep that can be run, or the problems of its world.
struct BegunSweep {
  std::optional<SweepFolder> folder;
  std::vector<worlds::Problem> problems;
};

/// Checks all settings, and begins the sweep or goes on with it, as begin_sweep does. Throws BadInput.
BegunSweep begin_sweep(const SweepChoices& choices, const std::filesystem::path& out,
                       const seif::Registry& registry);

/// Runs the cells of a shard that are not done, those that have failed among them, `jobs` at a time. False if
/// SIGINT or SIGTERM ended it before its time.
bool run_cells(const SweepFolder& sweep, const Shard& shard, int jobs, bool quiet,
               const seif::Registry& registry);

/// For a sweep without open cells.
Aggregate read_aggregate(const SweepFolder& sweep);

/// Writes runs.csv, times.csv, aggregate.csv and aggregate.json once no cell is open any more.
Aggregate write_tables(const SweepFolder& sweep);

/// Merges the cells of partial sweeps into one folder, which may be one of them. Throws BadInput.
SweepFolder merge_sweeps(const std::vector<std::string>& folders, const std::filesystem::path& out);

}  // namespace harness
