#include "harness/comparison/parallel_runs.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <utility>

#include "harness/files/bad_input.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/progress.hpp"

namespace harness {

namespace {

DetailedRun execute_guarded(const PlannedRun& planned) {
  try {
    return planned.run();
  } catch (const BadInput& error) {
    return {.result = {.summary = {}, .error = error.what(), .bad_input = true}};
  } catch (const std::exception& error) {
    return {.result = {.summary = {}, .error = error.what(), .bad_input = false}};
  }
}

}  // namespace

FinishedRuns execute_all(const std::vector<PlannedRun>& planned, int jobs, bool quiet) {
  const InterruptGuard guard;
  const std::atomic<bool>& stop = InterruptGuard::flag();
  std::vector<std::optional<DetailedRun>> results(planned.size());
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::mutex done_mutex;
  CountProgress progress(quiet, planned.size(), "runs");
  const auto work = [&] {
    for (std::size_t i = next++; i < planned.size() && !stop; i = next++) {
      DetailedRun run = execute_guarded(planned[i]);
      if (!run.result.summary.interrupted) results[i] = std::move(run);
      const std::lock_guard lock(done_mutex);
      progress.show(++done);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 1; i < std::min(jobs, static_cast<int>(planned.size())); ++i) threads.emplace_back(work);
    work();
  }
  FinishedRuns finished;
  finished.interrupted = stop;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    if (results[i])
      finished.runs.push_back(
          {planned[i].name, std::move(results[i]->result), std::move(results[i]->details)});
  }
  return finished;
}

}  // namespace harness
