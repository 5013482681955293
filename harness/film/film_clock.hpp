// The times of a film's frames. Only simulated time counts.
#pragma once

#include <cstdint>

namespace harness {

/// Frame i shows the time start + i speed / fps.
struct FilmClock {
  double start = 0.0;  // [s] of the first frame
  double end = 0.0;    // [s] no frame is later than this
  double speed = 1.0;  // [-] simulated time over film time
  int fps = 30;        // [1/s]

  double time_of(std::int64_t frame) const { return start + static_cast<double>(frame) * speed / fps; }
  std::int64_t frames() const;  // [-] at least one
};

/// The smallest speed of 1, 2, 5, 10, 20, 50, ... at which `duration` [s] of simulated time takes at most
/// `longest` [s] of film time.
double speed_for(double duration, double longest);

}  // namespace harness
