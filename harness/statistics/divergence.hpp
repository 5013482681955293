// Detects without the truth that a filter has diverged: a running test of its innovations.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace harness {

/// Follows the innovations of one estimator. Constant time and memory.
///
/// For a consistent filter, v' S^-1 v summed over scans has a chi-square distribution with as many degrees of
/// freedom as numbers were measured. The test fires if the sum over the last `window` scans that saw known
/// landmarks is beyond highest_nis(), or if the filter's gate ignored more of their observations than it used.
class InnovationTest {
 public:
  static constexpr std::size_t window = 10;  // [-] scans

  /// One update: v' S^-1 v, its degrees of freedom, and how many observations the gate left out of this scan.
  void add(double t, double innovation, int degrees, std::int64_t gated);

  /// The time when the test first fired; nothing if it never did. [s]
  std::optional<double> fired_t() const { return fired_t_; }
  /// The largest NIS over a window so far, for each degree of freedom; nothing before the first whole window.
  /// [-]
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

/// [-] The tolerated ratio of error to believed sigma: a filter may be overconfident by this factor, on ice or
/// with wrong wheels, and still recover.
inline constexpr double tolerated_sigma = 4.0;

/// The NIS per degree of freedom that a filter with the tolerated error exceeds once in a billion times: the
/// chi-square quantile over `degrees`, by Wilson and Hilferty's approximation, in constant time. [-]
double highest_nis(int degrees);

/// NEES of the pose per degree of freedom above which a filter has diverged: a consistent filter exceeds it once
/// in a million times. [-]
double highest_nees_pose();

}  // namespace harness
