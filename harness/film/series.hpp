// A quantity over time for a chart as wide as the run, in bounded memory.
#pragma once

#include <optional>
#include <vector>

namespace harness {

/// Equal intervals of time. Each keeps the median of its values, or of as many as it has memory for.
class Series {
 public:
  /// From `start` to `end` [s], in `bins` intervals.
  Series(double start, double end, int bins);

  /// Ignores values that are not finite.
  void add(double t, double value);

  int bins() const { return static_cast<int>(values_.size()); }
  double start() const { return start_; }
  double end() const { return end_; }
  double time_of(int bin) const;               // [s] its middle
  std::optional<double> value(int bin) const;  // the median
  std::optional<double> last() const { return last_; }
  std::optional<double> smallest() const;  // of the medians
  std::optional<double> largest() const;   // of the medians

 private:
  double start_;
  double end_;
  std::vector<std::vector<double>> values_;  // sorted
  std::optional<double> last_;
};

}  // namespace harness
