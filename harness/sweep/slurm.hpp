// Sweeps on a cluster under Slurm: a job array of shards that share the sweep's folder, and a job that merges
// their results. Only the folder is stored: Slurm knows what is in the queue.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "harness/sweep/folder.hpp"

namespace harness {

struct SlurmChoices {
  std::size_t tasks = 64;            // [-] shards, at most one for each cell
  int jobs = 1;                      // [-] runs at the same time in a task: its CPUs
  std::vector<std::string> options;  // handed to sbatch as they are
};

/// The jobs of one sweep that have not ended.
struct SlurmQueue {
  std::size_t running = 0;           // [-] tasks
  std::size_t pending = 0;           // [-] tasks
  std::optional<std::size_t> tasks;  // [-] into how many shards they divide the sweep
  std::set<std::size_t> shards;      // 1-based
  std::set<std::string> arrays;      // ids of jobs
  std::set<std::string> merges;      // ids of jobs
};

/// Distinguishes the jobs of this folder from all others: job names begin with it.
std::string slurm_name(const std::filesystem::path& folder);

/// Reads lines of `name|job|task|state`, of which those count whose name begins with slurm_name().
SlurmQueue parse_slurm_queue(std::string_view lines, std::string_view name);

/// Asks squeue. Throws std::runtime_error if that fails.
SlurmQueue slurm_queue(const SweepFolder& sweep);

/// Whether the sweep was ever given to Slurm.
bool is_slurm_sweep(const SweepFolder& sweep);

/// Submits the shards in which any cell is not done and which are not in the queue, and the job that merges
/// when all have ended. Returns what was done, for people. Throws BadInput if the queue holds tasks that
/// divide the sweep differently, and std::runtime_error if Slurm refuses.
std::string submit(const SweepFolder& sweep, const SlurmChoices& choices);

/// "Slurm: 3 tasks running, 5 pending".
std::string to_text(const SlurmQueue& queue);

}  // namespace harness
