// Sweeps on a cluster under Slurm: a job array of shards that share the sweep's folder, and a job that merges
// the results. Only the folder holds state; the queue is asked from Slurm.
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
  int jobs = 1;                      // [-] runs at the same time in a task: its number of CPUs
  std::vector<std::string> options;  // passed to sbatch unchanged
};

/// The jobs of one sweep that have not ended.
struct SlurmQueue {
  std::size_t running = 0;           // [-] tasks
  std::size_t pending = 0;           // [-] tasks
  std::optional<std::size_t> tasks;  // [-] number of shards of the sweep
  std::set<std::size_t> shards;      // 1-based
  std::set<std::string> arrays;      // ids of jobs
  std::set<std::string> merges;      // ids of jobs
};

/// The name by which the jobs of this folder are recognised: job names begin with it.
std::string slurm_name(const std::filesystem::path& folder);

/// Reads lines of `name|job|task|state`. Only lines whose name begins with `name`, as slurm_name() gives it,
/// count.
SlurmQueue parse_slurm_queue(std::string_view lines, std::string_view name);

/// Calls squeue. Throws std::runtime_error if that fails.
SlurmQueue slurm_queue(const SweepFolder& sweep);

/// True if the sweep was ever submitted to Slurm.
bool is_slurm_sweep(const SweepFolder& sweep);

/// Submits the shards that have unfinished cells and are not in the queue, and the job that merges when all
/// have ended. Returns a text that says what was done. Throws BadInput if the queue has tasks that divide the
/// sweep into another number of shards, and std::runtime_error if Slurm refuses.
std::string submit(const SweepFolder& sweep, const SlurmChoices& choices);

/// A text such as "Slurm: 3 tasks running, 5 pending".
std::string to_text(const SlurmQueue& queue);

}  // namespace harness
