#include "harness/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/run/recorded_run.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/messages.hpp"
#include "harness/terminal/progress.hpp"

namespace harness {

namespace {

/// Prints a message once something was left out. True if it did.
bool tell_of(const Screening& screening) {
  if (!screening.first_t()) return false;
  tell_warning(fmt::format("at {} s: an invalid measurement was ignored ({}); more of the kind are counted",
                           *screening.first_t(), screening.named().front().first));
  return true;
}

void run_loop(RecordedRun& run, const LogDescription& log, const RunPlan& plan) {
  const InterruptGuard guard;
  Progress progress(plan.quiet, log.start_t, plan.end_t);
  bool is_told = plan.quiet;
  static_cast<void>(run.attempt([&] {
    run.loop().run(InterruptGuard::flag(), [&](const LoopCounts& counts) {
      progress.show(counts.t);
      if (!is_told) is_told = tell_of(run.loop().screening());
    });
  }));
}

}  // namespace

RunResult execute(Stream& stream, const LogDescription& log, Believers& believers, const RunPlan& plan,
                  RunListener* follower) {
  RecordedRun run(stream, log, believers, plan, follower);
  run_loop(run, log, plan);
  return run.finish(run.loop().counts().interrupted);
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
