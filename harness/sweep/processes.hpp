// Jobs in separate processes: a crash of one does not affect the others.
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
  std::optional<int> exit_code;  // nothing: a signal ended it
  int signal = 0;

  bool is_good() const { return exit_code == 0; }
};

/// "ended by signal 11 (Segmentation fault)", or "ended with exit code 3".
std::string to_string(const ProcessEnd& end);

/// Forks a process for each job, at most `at_once` of them at a time, in which `run` is called; what it
/// returns is the exit code. `ended` is called here, in the order in which they end. When `stop` is set, no
/// more are begun, and those that run get SIGTERM; so do they when this process ends, however that comes. To
/// be called where there is one thread alone.
void run_in_processes(std::span<const std::size_t> jobs, int at_once, const std::atomic<bool>& stop,
                      const std::function<int(std::size_t)>& run,
                      const std::function<void(std::size_t, const ProcessEnd&)>& ended);

}  // namespace harness
