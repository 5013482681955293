// When a filter has diverged, by what it can know itself: a running test of its innovations, without the
// truth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace harness {

/// Follows the innovations of one estimator. Constant time and memory.
///
/// For a consistent filter, v' S^-1 v summed over scans has a chi-square distribution with as many degrees of
/// freedom as numbers were measured. The test fires where the sum over the last `window` scans that saw known
/// landmarks is beyond highest_nis(); or where the filter's gate has left out more of what was known than it
/// let in.
class InnovationTest {
 public:
  static constexpr std::size_t window = 10;  // [-] scans

  /// One update: v' S^-1 v, its degrees of freedom, and how many observations the gate left out of this scan.
  void add(double t, double innovation, int degrees, std::int64_t gated);

  /// When it first fired; nothing if it never did. [s]
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

/// [-] sigma that are believed to be one: so many a filter may be too sure of itself, on ice or with wrong
/// wheels, and find its way back.
inline constexpr double tolerated_sigma = 4.0;

/// The NIS for each degree of freedom that a filter which is as wrong as is tolerated exceeds once in a
/// billion times: the chi-square quantile over `degrees`, by Wilson and Hilferty's approximation, in constant
/// time. [-]
double highest_nis(int degrees);

/// NEES of the pose for each degree of freedom beyond which a filter has diverged: once in a million times of
/// a right one. [-]
double highest_nees_pose();

}  // namespace harness
