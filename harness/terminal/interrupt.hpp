// Handles SIGINT (Ctrl-C) and SIGTERM, so that a run can end properly.
#pragma once

#include <atomic>

namespace harness {

/// While a guard lives, SIGINT and SIGTERM set a flag. A second signal ends the program at once. Several
/// guards may live at once, in any thread, and share the flag.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// True if a signal has come since the oldest living guard was made.
  static const std::atomic<bool>& flag();
};

}  // namespace harness
