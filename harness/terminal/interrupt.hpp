// Ctrl-C and SIGTERM: a run ends properly.
#pragma once

#include <atomic>

namespace harness {

/// While any lives, SIGINT and SIGTERM set a flag. A second signal ends the program at once. Several may live
/// at once, in any thread, and share the flag.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether a signal came since there is a guard.
  static const std::atomic<bool>& flag();
};

}  // namespace harness
