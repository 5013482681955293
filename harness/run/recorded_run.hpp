// A run that is recorded to its folder while it goes on, and scored at its end.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "harness/files/file_lock.hpp"
#include "harness/recording/recorder.hpp"
#include "harness/run/live_loop.hpp"
#include "harness/run/run.hpp"

namespace harness {

class RecordedRun {
 public:
  /// Marks the folder as unfinished and opens its files. Keeps references to all arguments. `follower`, if there is
  /// one, is told each event after it was recorded. Throws std::system_error if the run cannot be recorded.
  RecordedRun(Stream& stream, const LogDescription& log, Believers& believers, const RunPlan& plan,
              RunListener* follower);
  RecordedRun(const RecordedRun&) = delete;
  RecordedRun& operator=(const RecordedRun&) = delete;

  LiveLoop& loop() { return loop_; }

  /// Makes a step of the run. An error is kept for the result, so that the run up to then can be scored; false after
  /// one. Passes on std::system_error: nothing more can be written.
  bool attempt(const std::function<void()>& step);

  /// Scores, writes summary.json and takes the mark away. To be called once, after the last step. `interrupted`: the
  /// user has ended the run.
  RunResult finish(bool interrupted);

 private:
  using Clock = std::chrono::steady_clock;
  void fill(Summary& summary, bool interrupted, double elapsed);

  Stream& stream_;
  const LogDescription& log_;
  Believers& believers_;
  const RunPlan& plan_;
  std::vector<std::string> names_;  // of the estimators
  FileLock alive_;
  Recorder recorder_;
  LiveLoop loop_;
  RunResult result_;
  Clock::time_point begin_;
};

}  // namespace harness
