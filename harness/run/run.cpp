#include "harness/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/file_lock.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/recorder.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/messages.hpp"
#include "harness/terminal/progress.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

std::vector<std::string> names_of(const Believers& believers) {
  std::vector<std::string> names;
  for (const LiveEstimator& estimator : believers.estimators) names.push_back(estimator.name);
  return names;
}

/// Prints a message once something was left out. True if it did.
bool tell_of(const Screening& screening) {
  if (!screening.first_t()) return false;
  tell_warning(fmt::format("at {} s: an invalid measurement was ignored ({}); more of the kind are counted",
                           *screening.first_t(), screening.named().front().first));
  return true;
}

/// Runs the loop. An error is stored in the result, so that the run up to then can be scored.
void run_loop(LiveLoop& loop, const LogDescription& log, const RunPlan& plan, RunResult& result) {
  const InterruptGuard guard;
  Progress progress(plan.quiet, log.start_t, plan.end_t);
  try {
    bool is_told = plan.quiet;
    loop.run(InterruptGuard::flag(), [&](const LoopCounts& counts) {
      progress.show(counts.t);
      if (!is_told) is_told = tell_of(loop.screening());
    });
  } catch (const std::system_error&) {
    throw;  // from the recorder: nothing more can be written
  } catch (const BadInput& error) {
    result.error = error.what();
    result.bad_input = true;
  } catch (const std::exception& error) {
    result.error = error.what();
  }
}

}  // namespace

RunResult execute(Stream& stream, const LogDescription& log, Believers& believers, const RunPlan& plan,
                  RunListener* follower) {
  using Clock = std::chrono::steady_clock;
  const std::vector<std::string> names = names_of(believers);
  RunResult result;
  believers.dead_reckoning = log.start.mean;
  OutputFile(plan.folder / unfinished_mark).close();
  const FileLock alive(plan.folder / unfinished_mark);
  Recorder recorder(plan.folder, log, names);
  std::vector<RunListener*> listeners = {&recorder};
  if (follower != nullptr) listeners.push_back(follower);
  LiveLoop loop(stream, believers, listeners, log, plan.scoring);
  for (const OptionChange& change : plan.option_changes) loop.change(change);
  const Clock::time_point begin = Clock::now();
  run_loop(loop, log, plan, result);
  const double elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
  loop.finish();
  recorder.close();
  result.is_void = result.bad_input && loop.counts().updates == 0;

  Summary& summary = result.summary;
  summary.world = plan.name;
  summary.seed = plan.seed;
  summary.version = program_version();
  summary.duration = loop.counts().t - log.start_t;
  summary.updates = loop.counts().updates;
  summary.interrupted = loop.counts().interrupted;
  summary.error = result.error;
  summary.trajectory_hash = trajectory_hash(plan.folder);
  summary.realtime_factor = summary.duration / elapsed;
  summary.notes = plan.notes;
  summary.rpe_interval = plan.scoring.rpe_interval;
  for (const auto& [name, count] : named(stream.counts())) summary.log_counts.emplace_back(name, count);
  for (const auto& [name, count] : loop.screening().named()) summary.left_out.emplace_back(name, count);
  summary.left_out_t = loop.screening().first_t();
  summary.score = score_folder(plan.folder, names, plan.scoring.rpe_interval);
  for (const LiveEstimator& estimator : believers.estimators) summary.failures.push_back(estimator.failure);
  Summary written = summary;
  written.interrupted = summary.interrupted || result.bad_input;  // the folder holds a part of the log
  write_whole_file(plan.folder / "summary.json", to_json(written));
  std::filesystem::remove(plan.folder / unfinished_mark);
  return result;
}

int exit_code(const RunResult& result) {
  if (result.bad_input) return 2;
  if (!result.error.empty()) return 1;
  if (result.summary.interrupted) return 130;
  const bool failed =
      std::ranges::any_of(result.summary.failures, [](const std::string& f) { return !f.empty(); });
  return failed ? 1 : 0;
}

}  // namespace harness
