// Ctrl-C and the request to terminate: a run ends properly.
#pragma once

#include <atomic>

namespace harness {

/// While it lives, SIGINT and SIGTERM set a flag. A second signal ends the program at once. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether a signal came since the last guard was made.
  static const std::atomic<bool>& flag();
};

}  // namespace harness
