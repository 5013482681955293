// Lets simulated time keep pace with time.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>

namespace harness {

class Pacer {
 public:
  using Clock = std::chrono::steady_clock;

  /// Simulated time over time; infinity: as fast as it goes. [-]
  void set_speed(double speed, double t, Clock::time_point now) {
    speed_ = speed;
    restart(t, now);
  }
  double speed() const { return speed_; }

  /// From here on: simulated time `t` [s] belongs to `now`.
  void restart(double t, Clock::time_point now) {
    t_ = mark_t_ = t;
    now_ = mark_ = now;
    measured_ = 0.0;
  }

  /// The time that belongs to the simulated time `t` [s]. What a slow machine has lost is not caught up.
  Clock::time_point due(double t, Clock::time_point now) {
    measure(t, now);
    if (std::isinf(speed_)) return now;
    const Clock::time_point due = now_ + duration((t - t_) / speed_);
    if (now - due > std::chrono::milliseconds(200)) {
      t_ = t;
      now_ = now;
      return now;
    }
    return due;
  }

  /// Simulated time over time, as measured about once a second. [-]
  double measured() const { return measured_; }

 private:
  static Clock::duration duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(seconds, 1e6)));
  }

  void measure(double t, Clock::time_point now) {
    const double passed = std::chrono::duration<double>(now - mark_).count();
    if (passed < 1.0) return;
    measured_ = (t - mark_t_) / passed;
    mark_t_ = t;
    mark_ = now;
  }

  double speed_ = 1.0;
  double t_ = 0.0, mark_t_ = 0.0;  // [s]
  Clock::time_point now_, mark_;
  double measured_ = 0.0;  // [-]
};

}  // namespace harness
