// Sweeps: many runs of a world, each in its own process. Runs that are already done are skipped.
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

/// The cells number, number + of, number + 2 of, ...; `number` is 1-based.
struct Shard {
  std::size_t number = 1;
  std::size_t of = 1;
};

/// Reads "3/16". Throws BadInput.
Shard parse_shard(std::string_view text);

/// The sweep options of the command line.
struct SweepChoices {
  std::filesystem::path world;
  std::string seeds;
  std::vector<std::string> axes;       // path=v1,v2,..
  std::vector<std::string> overrides;  // path.to.key=value, for all runs
  std::string baseline;                // empty: the ekf, otherwise the first
};

/// A sweep that can be run, or the problems of its world.
struct BegunSweep {
  std::optional<SweepFolder> folder;
  std::vector<worlds::Problem> problems;
};

/// Checks all settings, and begins or continues the sweep as begin_sweep() of a folder does. Throws BadInput.
BegunSweep begin_sweep(const SweepChoices& choices, const std::filesystem::path& out,
                       const seif::Registry& registry);

/// Runs the cells of a shard that are not done, also those that failed before, `jobs` at a time. False if
/// SIGINT or SIGTERM ended it early.
bool run_cells(const SweepFolder& sweep, const Shard& shard, int jobs, bool quiet,
               const seif::Registry& registry);

/// Aggregates a sweep in which no cell is open.
Aggregate read_aggregate(const SweepFolder& sweep);

/// Writes runs.csv, times.csv, aggregate.csv and aggregate.json. No cell may be open.
Aggregate write_tables(const SweepFolder& sweep);

/// Merges sweeps that are parts of one sweep into one folder, which may be one of theirs. Throws BadInput.
SweepFolder merge_sweeps(const std::vector<std::string>& folders, const std::filesystem::path& out);

}  // namespace harness
