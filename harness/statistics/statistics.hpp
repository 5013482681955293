// Means over runs, and their confidence intervals. Definitions: docs/scores.md.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace harness {

struct ConfidenceInterval {
  double low = 0.0;
  double high = 0.0;
};

/// A value from a sample, with its 95 % confidence interval if the sample gives one.
struct Estimate {
  double value = 0.0;
  std::optional<ConfidenceInterval> interval;
};

/// The mean, with Student's interval: for values of either sign. A single value gives no interval; an empty
/// sample gives no mean.
std::optional<Estimate> mean_of(std::span<const double> sample);

/// The mean of values that cannot be negative and may be skewed, with an interval that is never below zero.
/// From eight values on it is the BCa bootstrap's (bootstrap.hpp). With fewer, the bootstrap is too narrow; the
/// interval is then Student's for the logarithm of the mean. It is missing for fewer than three values, and if
/// a value is not finite. Equal samples give equal bits. If a value is negative after all, this is mean_of().
std::optional<Estimate> mean_of_positive(std::span<const double> sample);

/// The geometric mean of the ratios of pairs, with Student's interval for the mean of their logarithms. The
/// interval is missing for fewer than three pairs. Empty if there are no pairs, or if a ratio is zero, infinite
/// or undefined, because it has no logarithm. The spans have equal lengths.
std::optional<Estimate> ratio_of_pairs(std::span<const double> numerators,
                                       std::span<const double> denominators);

/// The ratio of the means of two paired samples, with Fieller's interval (1954), which accounts for the
/// correlation of the pairs. No value is negative. The interval is missing for a single pair. It is also
/// missing if one of the two means is not significantly above zero, because the interval is unbounded or reaches
/// below zero then. Empty if there are no pairs or if the mean of the denominators is zero. The spans have equal
/// lengths.
std::optional<Estimate> ratio_of_means(std::span<const double> numerators,
                                       std::span<const double> denominators);

/// The slope of the least-squares line through the points (x, y), with Student's interval. Two points give no
/// interval. Empty for fewer points, or if all x are equal. The spans have equal lengths.
std::optional<Estimate> slope_of(std::span<const double> x, std::span<const double> y);

/// The middle value, or the mean of the two middle values. Empty if there are no values.
std::optional<double> median_of(std::vector<double> sample);

}  // namespace harness
