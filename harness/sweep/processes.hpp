// Runs jobs in separate processes, so that the crash of one does not affect the others.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace harness {

/// How a process ended.
struct ProcessEnd {
  std::optional<int> exit_code;  // empty: a signal ended it
  int signal = 0;

  bool is_good() const { return exit_code == 0; }
};

/// A text such as "ended by signal 11 (Segmentation fault)" or "ended with exit code 3".
std::string to_string(const ProcessEnd& end);

/// Forks a process for each job, at most `at_once` at a time. The process calls `run`, whose result is its
/// exit code. `ended` is called in this process, in the order in which the jobs end. When `stop` is set, no
/// more jobs begin, and the running ones get SIGTERM. They also get SIGTERM if this process ends for any
/// reason. There must be no other thread when this is called.
void run_in_processes(std::span<const std::size_t> jobs, int at_once, const std::atomic<bool>& stop,
                      const std::function<int(std::size_t)>& run,
                      const std::function<void(std::size_t, const ProcessEnd&)>& ended);

}  // namespace harness
