#include "harness/sweep/processes.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <map>
#include <system_error>

namespace harness {

namespace {

/// Blocks the signal that a child has ended, so that wait() can wait for it.
class ChildSignalBlock {
 public:
  ChildSignalBlock() {
    // The parent may have ignored the signal; the system would then not keep the exit codes of children.
    std::signal(SIGCHLD, SIG_DFL);
    sigemptyset(&child_);
    sigaddset(&child_, SIGCHLD);
    pthread_sigmask(SIG_BLOCK, &child_, &before_);
  }
  ~ChildSignalBlock() { lift(); }
  ChildSignalBlock(const ChildSignalBlock&) = delete;
  ChildSignalBlock& operator=(const ChildSignalBlock&) = delete;

  void lift() const { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

  /// Waits until a child ends, another signal comes, or 0.1 s have passed.
  void wait() const {
    constexpr timespec a_while{0, 100'000'000};  // [s, ns]
    sigtimedwait(&child_, nullptr, &a_while);
  }

 private:
  sigset_t child_{};
  sigset_t before_{};
};

/// Ends with _exit: the parent's buffers and objects must not be flushed or destroyed by the child.
[[noreturn]] void be_child(pid_t parent, std::size_t job, const std::function<int(std::size_t)>& run) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // the parent ended before the line above took effect
  int code = 1;
  try {
    code = run(job);
  } catch (...) {
    code = 1;
  }
  _exit(code);
}

ProcessEnd end_of(int status) {
  if (WIFSIGNALED(status)) return {std::nullopt, WTERMSIG(status)};
  return {WEXITSTATUS(status), 0};
}

class Processes {
 public:
  bool empty() const { return jobs_.empty(); }
  std::size_t size() const { return jobs_.size(); }

  void begin(std::size_t job, const std::function<int(std::size_t)>& run) {
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process < 0) throw std::system_error(errno, std::generic_category(), "cannot start a process");
    if (process == 0) {
      signals_.lift();
      be_child(parent, job, run);
    }
    jobs_.emplace(process, job);
  }

  /// Reports the children that have ended. If there are none, waits.
  void gather(const std::function<void(std::size_t, const ProcessEnd&)>& ended) {
    bool is_any = false;
    int status = 0;
    for (pid_t process = waitpid(-1, &status, WNOHANG); process > 0;
         process = waitpid(-1, &status, WNOHANG)) {
      const auto node = jobs_.extract(process);
      if (node.empty()) continue;
      is_any = true;
      ended(node.mapped(), end_of(status));
    }
    if (!is_any) signals_.wait();
  }

  void terminate() const {
    for (const auto& [process, job] : jobs_) kill(process, SIGTERM);
  }

 private:
  ChildSignalBlock signals_;
  std::map<pid_t, std::size_t> jobs_;
};

}  // namespace

std::string to_string(const ProcessEnd& end) {
  if (end.exit_code) return fmt::format("ended with exit code {}", *end.exit_code);
  const char* description = sigdescr_np(end.signal);
  return fmt::format("ended by signal {} ({})", end.signal, description ? description : "unknown");
}

void run_in_processes(std::span<const std::size_t> jobs, int at_once, const std::atomic<bool>& stop,
                      const std::function<int(std::size_t)>& run,
                      const std::function<void(std::size_t, const ProcessEnd&)>& ended) {
  Processes processes;
  bool is_stopping = false;
  while (!processes.empty() || (!jobs.empty() && !is_stopping)) {
    if (stop && !is_stopping) {
      processes.terminate();
      is_stopping = true;
      continue;
    }
    while (!is_stopping && !jobs.empty() && processes.size() < static_cast<std::size_t>(at_once)) {
      processes.begin(jobs.front(), run);
      jobs = jobs.subspan(1);
    }
    processes.gather(ended);
  }
}

}  // namespace harness
