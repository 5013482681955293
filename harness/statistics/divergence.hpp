// Detects that a filter has diverged with a running test of its innovations. The test needs no truth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace harness {

/// Follows the innovations of one estimator. Constant time and memory.
///
/// The sum of v' S^-1 v over scans of a consistent filter has a chi-square distribution; its degrees of
/// freedom are the number of measured values. The test looks at the last `window` scans that observed known
/// landmarks. The test fires if their sum exceeds highest_nis(), or if the filter's gate rejected more
/// observations of known landmarks than it accepted.
class InnovationTest {
 public:
  static constexpr std::size_t window = 10;  // [scans]

  /// One update: v' S^-1 v, its degrees of freedom, and how many observations of this scan the gate rejected.
  void add(double t, double innovation, int degrees, std::int64_t gated);

  /// The time at which the test first fired; empty if it never fired. [s]
  std::optional<double> fired_t() const { return fired_t_; }
  /// The largest NIS per degree of freedom over a window so far; empty before the first whole window. [-]
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

/// [-] The test tolerates errors with up to this many times the standard deviation that the filter states. A
/// filter may be this overconfident on ice or with wrong wheel parameters, and still recover.
inline constexpr double tolerated_sigma = 4.0;

/// The limit of the NIS per degree of freedom. A filter that is exactly as overconfident as tolerated exceeds
/// this limit with probability 1e-9. Computed as the chi-square quantile divided by `degrees`, with the
/// approximation of Wilson and Hilferty, in constant time. [-]
double highest_nis(int degrees);

/// A filter has diverged if the NEES of its pose per degree of freedom exceeds this limit. A consistent
/// filter exceeds the limit with probability 1e-6. [-]
double highest_nees_pose();

}  // namespace harness
