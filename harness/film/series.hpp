// A quantity over time, for a chart of a whole run, in bounded memory.
#pragma once

#include <optional>
#include <vector>

namespace harness {

/// Divides the time into equal intervals and gives the median of each. An interval keeps a bounded number of
/// values.
class Series {
 public:
  /// Covers the time from `start` to `end` [s] with `bins` intervals.
  Series(double start, double end, int bins);

  /// Ignores a value that is not finite.
  void add(double t, double value);

  int bins() const { return static_cast<int>(values_.size()); }
  double start() const { return start_; }
  double end() const { return end_; }
  double time_of(int bin) const;               // [s] middle of the interval
  std::optional<double> value(int bin) const;  // median of the interval; empty: no values
  std::optional<double> last() const { return last_; }
  std::optional<double> smallest() const;  // smallest median
  std::optional<double> largest() const;   // largest median

 private:
  double start_;
  double end_;
  std::vector<std::vector<double>> values_;  // sorted
  std::optional<double> last_;
};

}  // namespace harness
