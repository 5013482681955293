// Keeps the cost of watching a run below a share of the run's time.
#pragma once

#include <algorithm>
#include <chrono>

namespace harness {

class Thrift {
 public:
  using Clock = std::chrono::steady_clock;

  /// Spends at most this share [-] of the time, and not more often than every `period`.
  Thrift(double share, Clock::duration period) : share_(share), period_(period) {}

  bool may(Clock::time_point now) const { return now >= next_; }

  /// What was spent from `begin` to `end`: the next time is so much later.
  void spent(Clock::time_point begin, Clock::time_point end) {
    const auto pause = std::chrono::duration_cast<Clock::duration>((end - begin) / share_);
    next_ = begin + (pause > period_ ? pause : period_);
  }

  /// Not before `next`, whatever was spent.
  void pause_until(Clock::time_point next) { next_ = std::max(next_, next); }

 private:
  double share_;
  Clock::duration period_;
  Clock::time_point next_;
};

}  // namespace harness
