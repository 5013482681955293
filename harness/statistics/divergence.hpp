// Detects that a filter has diverged without the truth, by a running test of the filter's innovations.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace harness {

/// Tests the innovations of one estimator, in constant time and memory.
///
/// For a consistent filter, the sum of v' S^-1 v over scans has a chi-square distribution; its degrees of
/// freedom are the number of measured values. The test looks at the last `window` scans that saw known
/// landmarks. It fires if their sum is above highest_nis(), or if the filter's gate left out more of the
/// known landmarks' observations than it let in.
class InnovationTest {
 public:
  static constexpr std::size_t window = 10;  // [-] scans

  /// Adds one update: v' S^-1 v, its degrees of freedom, and the number of observations that the gate left
  /// out of the scan.
  void add(double t, double innovation, int degrees, std::int64_t gated);

  /// The time at which the test first fired; empty if it never did. [s]
  std::optional<double> fired_t() const { return fired_t_; }
  /// The largest NIS of a window so far, per degree of freedom; empty before the first full window. [-]
  std::optional<double> worst() const { return worst_; }

 private:
  struct ScanSum {
    double innovation = 0.0;  // [-]
    int degrees = 0;          // [-]
    std::int64_t gated = 0;   // [-] observations
  };

  std::array<ScanSum, window> scans_ = {};
  std::size_t added_ = 0;  // [-]
  std::optional<double> fired_t_;
  std::optional<double> worst_;
};

/// [-] errors of so many believed sigma are tolerated: on ice or with wrong wheel sizes a filter may be
/// overconfident for a while and recover.
inline constexpr double tolerated_sigma = 4.0;

/// The bound for a window's NIS per degree of freedom. A filter with errors of tolerated_sigma exceeds it
/// once in a billion times. It is the chi-square quantile over `degrees`, by the approximation of Wilson and
/// Hilferty, in constant time. [-]
double highest_nis(int degrees);

/// The bound for the pose's NEES per degree of freedom, above which a filter has diverged. A consistent
/// filter exceeds it once in a million times. [-]
double highest_nees_pose();

}  // namespace harness
