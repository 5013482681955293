#include "harness/film/film_clock.hpp"

#include <algorithm>
#include <cmath>

namespace harness {

std::int64_t FilmClock::frames() const {
  constexpr double rounding = 1e-9;  // [-] of a frame
  const double intervals = (end - start) * fps / speed;
  return std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor(intervals + rounding))) + 1;
}

double speed_for(double duration, double longest) {
  for (double decade = 1.0;; decade *= 10.0) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (duration <= longest * digit * decade) return digit * decade;
    }
  }
}

}  // namespace harness
