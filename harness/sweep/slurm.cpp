#include "harness/sweep/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>

#include "harness/files/bad_input.hpp"
#include "harness/files/fnv1a.hpp"
#include "harness/sweep/shell.hpp"

namespace harness {

namespace {

std::optional<std::size_t> to_number(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Removes the part before the next separator from the text and returns it.
std::string_view take_until(char separator, std::string_view& text) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

void add_task(std::size_t tasks, std::string_view job, std::string_view task, std::string_view state,
              SlurmQueue& queue) {
  const std::optional<std::size_t> shard = to_number(task);
  if (!shard) return;
  queue.tasks = tasks;
  queue.shards.insert(*shard);
  queue.arrays.emplace(job);
  ++(state == "PENDING" ? queue.pending : queue.running);
}

std::filesystem::path slurm_folder(const SweepFolder& sweep) { return sweep.path / "slurm"; }

/// The shards with a cell that is not done, 1-based.
std::set<std::size_t> lost_shards(const SweepFolder& sweep, std::size_t tasks) {
  const std::vector<CellState> states = sweep.states();
  std::set<std::size_t> lost;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] != CellState::done) lost.insert(i % tasks + 1);
  }
  return lost;
}

/// Writes a script of one line and submits it. Returns the id of the job.
std::string submit_script(const SweepFolder& sweep, const std::string& name, const std::string& log,
                          const std::string& arguments, std::vector<std::string> options) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::filesystem::path script = slurm_folder(sweep) / (name + ".sh");
  write_durable_file(script, fmt::format("#!/bin/sh\nexec {} {}\n", shell_quoted(program), arguments));
  std::vector<std::string> call = {"sbatch", "--parsable", "--job-name=" + slurm_name(sweep.path) + name,
                                   "--output=" + (slurm_folder(sweep) / log).string()};
  call.insert(call.end(), options.begin(), options.end());
  call.push_back(script.string());
  const std::string answer = output_of(call);
  return answer.substr(0, answer.find_first_of(";\n"));
}

std::string submit_tasks(const SweepFolder& sweep, const SlurmChoices& choices, std::size_t tasks,
                         const std::set<std::size_t>& shards) {
  std::vector<std::string> options = {fmt::format("--array={}", fmt::join(shards, ",")),
                                      fmt::format("--cpus-per-task={}", choices.jobs)};
  options.insert(options.end(), choices.options.begin(), choices.options.end());
  return submit_script(sweep, fmt::format("{}", tasks), "%A_%a.log",
                       fmt::format("sweep --resume {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --jobs {} --quiet",
                                   shell_quoted(sweep.path.string()), tasks, choices.jobs),
                       options);
}

std::string submit_merge(const SweepFolder& sweep, const SlurmChoices& choices,
                         const std::set<std::string>& arrays) {
  std::vector<std::string> options = {fmt::format("--dependency=afterany:{}", fmt::join(arrays, ":"))};
  options.insert(options.end(), choices.options.begin(), choices.options.end());
  const std::string folder = shell_quoted(sweep.path.string());
  return submit_script(sweep, "merge", "%j_merge.log", fmt::format("merge {} --out {}", folder, folder),
                       options);
}

}  // namespace

std::string slurm_name(const std::filesystem::path& folder) {
  Fnv1a hash;
  hash.add(folder.string());
  return fmt::format("seifbed-{:016x}-", hash.value());
}

SlurmQueue parse_slurm_queue(std::string_view lines, std::string_view name) {
  SlurmQueue queue;
  while (!lines.empty()) {
    std::string_view line = take_until('\n', lines);
    std::string_view job_name = take_until('|', line);
    const std::string_view job = take_until('|', line);
    const std::string_view task = take_until('|', line);
    if (!job_name.starts_with(name) || line == "COMPLETING") continue;
    job_name.remove_prefix(name.size());
    if (job_name == "merge") queue.merges.emplace(job);
    if (const std::optional<std::size_t> tasks = to_number(job_name))
      add_task(*tasks, job, task, line, queue);
  }
  return queue;
}

SlurmQueue slurm_queue(const SweepFolder& sweep) {
  return parse_slurm_queue(output_of({"squeue", "--me", "--noheader", "--array", "--format=%j|%F|%K|%T"}),
                           slurm_name(sweep.path));
}

bool is_slurm_sweep(const SweepFolder& sweep) { return std::filesystem::exists(slurm_folder(sweep)); }

std::string submit(const SweepFolder& sweep, const SlurmChoices& choices) {
  const std::size_t tasks = std::min(choices.tasks, cell_count(sweep.plan));
  SlurmQueue queue = slurm_queue(sweep);
  if (queue.tasks && *queue.tasks != tasks)
    throw BadInput(fmt::format("--array: the queue holds tasks that divide the sweep by {}, and not by {}",
                               *queue.tasks, tasks));
  std::set<std::size_t> shards = lost_shards(sweep, tasks);
  std::erase_if(shards, [&](std::size_t shard) { return queue.shards.contains(shard); });
  if (shards.empty()) return fmt::format("nothing to submit; {}\n", to_text(queue));
  std::filesystem::create_directories(slurm_folder(sweep));
  const std::string array = submit_tasks(sweep, choices, tasks, shards);
  queue.arrays.insert(array);
  const std::string merge = submit_merge(sweep, choices, queue.arrays);
  for (const std::string& old : queue.merges) output_of({"scancel", old});
  return fmt::format("submitted {} of {} tasks as job {}, and job {} to merge what all have done\n",
                     shards.size(), tasks, array, merge);
}

std::string to_text(const SlurmQueue& queue) {
  return fmt::format("Slurm: {} tasks running, {} pending", queue.running, queue.pending);
}

}  // namespace harness
