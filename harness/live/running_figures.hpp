// The figures of an estimator so far, in bounded memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/live/snapshot.hpp"
#include "harness/stream/run_listener.hpp"

namespace harness {

/// Quantiles of many positive numbers, to 1 %: counts in bins of equal ratio.
class QuantileCounts {
 public:
  /// From 0.01 to 1e8; what lies outside counts for the nearest bin.
  void add(double value);
  /// 0 if there are no values.
  double quantile(double share) const;

 private:
  static constexpr std::size_t bins = 2315;  // [-]
  std::array<std::int64_t, bins> counts_ = {};
  std::int64_t total_ = 0;
};

class RunningFigures {
 public:
  void update(const UpdateRecord& record);
  void consistency(const ConsistencyRecord& record);

  const LiveFigures& figures() const { return figures_; }
  /// Fills in what takes a pass over bounded counts.
  void read_quantiles();

  /// The charts' points since the last call, at most `most_points`; where there were more, every other one.
  void hand_over(std::vector<LiveChartPoint>& points);

 private:
  static constexpr std::size_t most_points = 1024;  // [-]

  LiveFigures figures_;
  QuantileCounts times_;
  double squares_ = 0.0;     // [m^2] sum of squared position errors
  std::int64_t errors_ = 0;  // [-]
  std::vector<LiveChartPoint> points_;
};

/// Leaves every other element in its place.
template <class Value>
void halve(std::vector<Value>& values) {
  for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
  values.resize((values.size() + 1) / 2);
}

}  // namespace harness
