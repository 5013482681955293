#include "harness/report/interval_marks.hpp"

#include <utility>

namespace harness {

void add_interval(double x, const ConfidenceInterval& interval, FigureCurve& curve) {
  constexpr double half_cap = 0.02;
  for (const auto& [px, py] : {std::pair(x - half_cap, interval.low), std::pair(x + half_cap, interval.low),
                               std::pair(gap, gap), std::pair(x, interval.low), std::pair(x, interval.high),
                               std::pair(gap, gap), std::pair(x - half_cap, interval.high),
                               std::pair(x + half_cap, interval.high), std::pair(gap, gap)}) {
    curve.x.push_back(px);
    curve.y.push_back(py);
  }
}

}  // namespace harness
