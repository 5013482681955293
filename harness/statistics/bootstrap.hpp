// The BCa bootstrap's confidence interval of a mean. Definition: docs/scores.md.
#pragma once

#include <span>

#include "harness/statistics/statistics.hpp"

namespace harness {

/// The shares of the resamples below the two ends of an interval.
struct BcaLevels {
  double low = 0.0;
  double high = 0.0;
};

/// Efron and Tibshirani (1993), equation 14.10. `half_width` is that of the interval in standard deviations of
/// the normal distribution: 1.645 for 90 %.
BcaLevels bca_levels(double bias_correction, double acceleration, double half_width);

/// The bias-corrected and accelerated interval (BCa) of the mean, which lies between the least and the largest
/// value. The values are finite, at least two, and not all equal. The resamples come from a generator of fixed
/// seed, by integer arithmetic: equal samples give equal bits on every machine.
ConfidenceInterval bca_interval_of_mean(std::span<const double> sample, double half_width);

}  // namespace harness
