#include "python/long_call.hpp"

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <mutex>
#include <thread>

namespace seifbed {

namespace {

std::atomic<bool> ending = false;
std::atomic<int> calls = 0;  // [-] without the GIL

std::mutex signals_mutex;
int long_calls = 0;  // [-] that may be interrupted
struct sigaction on_interrupt, on_termination;

void restore_signals() {
  sigaction(SIGINT, &on_interrupt, nullptr);
  sigaction(SIGTERM, &on_termination, nullptr);
}

sigset_t mask_before_fork;

/// A signal to the new process waits until that has its own handlers.
void before_fork() {
  signals_mutex.lock();
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, &mask_before_fork);
}

void after_fork() {
  pthread_sigmask(SIG_SETMASK, &mask_before_fork, nullptr);
  signals_mutex.unlock();
}

/// The other threads are not there in a forked process, nor do their calls end. It must not take the signals for them:
/// multiprocessing ends its processes with SIGTERM.
void after_fork_in_child() {
  if (long_calls > 0) restore_signals();
  long_calls = 0;
  calls = 0;
  after_fork();
}

[[maybe_unused]] const int minds_forks = pthread_atfork(before_fork, after_fork, after_fork_in_child);

}  // namespace

CallCount::CallCount() {
  if (ending) {
    PyErr_SetNone(PyExc_SystemExit);
    throw pybind11::error_already_set();
  }
  ++calls;
}

CallCount::~CallCount() { --calls; }

PythonSignals::PythonSignals() {
  const std::lock_guard lock(signals_mutex);
  if (long_calls++ > 0) return;
  sigaction(SIGINT, nullptr, &on_interrupt);
  sigaction(SIGTERM, nullptr, &on_termination);
}

PythonSignals::~PythonSignals() {
  const std::lock_guard lock(signals_mutex);
  if (--long_calls == 0) restore_signals();
}

void end_calls() {
  ending = true;
  if (calls == 0) return;
  const pybind11::gil_scoped_release released;
  {
    // The guard of a long call takes this signal; it has none to take a second one.
    const std::lock_guard lock(signals_mutex);
    if (long_calls > 0 && !harness::InterruptGuard::flag()) std::raise(SIGINT);
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (calls > 0 && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace seifbed
