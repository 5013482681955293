// Keeps the cost of watching a run below a share of the run's time.
#pragma once

#include <algorithm>
#include <chrono>

namespace harness {

class Thrift {
 public:
  using Clock = std::chrono::steady_clock;

  /// Spends at most `share` [-] of the time of a busy run, and `idle_share` while the run waits; not more often than
  /// every `period`.
  Thrift(double share, double idle_share, Clock::duration period)
      : share_(share), idle_share_(idle_share), period_(period) {}

  bool may(Clock::time_point now, bool is_idle) const { return now >= (is_idle ? next_idle_ : next_); }

  /// What was spent from `begin` on: the next time is so much later.
  void spent(Clock::time_point begin, Clock::duration cost) {
    next_ = begin + std::max(period_, scaled(cost, share_));
    next_idle_ = begin + std::max(period_, scaled(cost, idle_share_));
  }

  /// Not before `next`, whatever was spent.
  void pause_until(Clock::time_point next) {
    next_ = std::max(next_, next);
    next_idle_ = std::max(next_idle_, next);
  }

 private:
  static Clock::duration scaled(Clock::duration cost, double share) {
    return std::chrono::duration_cast<Clock::duration>(cost / share);
  }

  double share_, idle_share_;
  Clock::duration period_;
  Clock::time_point next_, next_idle_;
};

}  // namespace harness
