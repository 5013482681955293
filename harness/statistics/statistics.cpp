#include "harness/statistics/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <numeric>

#include "harness/statistics/bootstrap.hpp"

namespace harness {

namespace {

/// The half width of the central 95 % of Student's distribution, in standard errors.
double student_quantile(std::size_t degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(degrees_of_freedom)), 0.975);
}

double mean(std::span<const double> sample) {
  return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
}

/// The covariance of the means of two paired samples. If both are the same sample, this is the variance of
/// its mean.
double covariance_of_means(std::span<const double> a, std::span<const double> b) {
  const double mean_a = mean(a);
  const double mean_b = mean(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  const auto n = static_cast<double>(a.size());
  return sum / (n - 1) / n;
}

constexpr std::size_t fewest_for_interval = 3;
constexpr std::size_t fewest_for_bootstrap = 8;

/// Student's interval for the logarithm of the mean; the standard error of the logarithm is to first order the
/// relative one of the mean.
ConfidenceInterval log_interval(double mean, std::span<const double> sample) {
  const double relative_error = std::sqrt(covariance_of_means(sample, sample)) / mean;
  const double half = student_quantile(sample.size() - 1) * relative_error;
  return {mean * std::exp(-half), mean * std::exp(half)};
}

}  // namespace

std::optional<Estimate> mean_of(std::span<const double> sample) {
  if (sample.empty()) return std::nullopt;
  Estimate estimate{mean(sample), std::nullopt};
  if (sample.size() < 2) return estimate;
  const double half = student_quantile(sample.size() - 1) * std::sqrt(covariance_of_means(sample, sample));
  estimate.interval = {estimate.value - half, estimate.value + half};
  return estimate;
}

std::optional<Estimate> mean_of_positive(std::span<const double> sample) {
  if (sample.empty()) return std::nullopt;
  if (std::ranges::min(sample) < 0.0) return mean_of(sample);
  Estimate estimate{mean(sample), std::nullopt};
  const bool is_finite = std::ranges::all_of(sample, [](double value) { return std::isfinite(value); });
  if (sample.size() < fewest_for_interval || !is_finite) return estimate;
  if (std::ranges::min(sample) == std::ranges::max(sample)) {
    estimate.value = sample.front();
    estimate.interval = {estimate.value, estimate.value};
  } else if (sample.size() < fewest_for_bootstrap) {
    estimate.interval = log_interval(estimate.value, sample);
  } else {
    // Hesterberg's expansion (2015): without it the bootstrap's intervals are too narrow for small samples.
    const auto n = static_cast<double>(sample.size());
    estimate.interval =
        bca_interval_of_mean(sample, student_quantile(sample.size() - 1) * std::sqrt(n / (n - 1)));
  }
  return estimate;
}

std::optional<Estimate> ratio_of_pairs(std::span<const double> numerators,
                                       std::span<const double> denominators) {
  assert(numerators.size() == denominators.size());
  std::vector<double> logarithms;
  for (std::size_t i = 0; i < numerators.size(); ++i) {
    logarithms.push_back(std::log(numerators[i] / denominators[i]));
    if (!std::isfinite(logarithms.back())) return std::nullopt;
  }
  std::optional<Estimate> estimate = mean_of(logarithms);
  if (!estimate) return std::nullopt;
  estimate->value = std::exp(estimate->value);
  if (logarithms.size() < fewest_for_interval) estimate->interval = std::nullopt;
  if (estimate->interval)
    estimate->interval = {std::exp(estimate->interval->low), std::exp(estimate->interval->high)};
  return estimate;
}

/// The interval contains every ratio rho for which the mean of (numerator - rho * denominator) is not
/// significantly different from zero: (y - rho x)^2 <= t^2 var(y - rho x), or a rho^2 - 2 b rho + c <= 0.
std::optional<Estimate> ratio_of_means(std::span<const double> numerators,
                                       std::span<const double> denominators) {
  assert(numerators.size() == denominators.size());
  if (numerators.empty()) return std::nullopt;
  const double y = mean(numerators);
  const double x = mean(denominators);
  if (x == 0.0) return std::nullopt;
  Estimate estimate{y / x, std::nullopt};
  if (numerators.size() < 2) return estimate;
  const double t = student_quantile(numerators.size() - 1);
  const double a = x * x - t * t * covariance_of_means(denominators, denominators);
  const double b = x * y - t * t * covariance_of_means(denominators, numerators);
  const double c = y * y - t * t * covariance_of_means(numerators, numerators);
  if (a <= 0.0 || c < 0.0) return estimate;
  const double root = std::sqrt(std::max(0.0, b * b - a * c));  // rounding may make the argument negative
  estimate.interval = {(b - root) / a, (b + root) / a};
  return estimate;
}

std::optional<Estimate> slope_of(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size());
  const std::size_t n = x.size();
  if (n < 2) return std::nullopt;
  const double mean_x = mean(x);
  const double mean_y = mean(y);
  double S_xx = 0.0;
  double S_xy = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    S_xx += (x[i] - mean_x) * (x[i] - mean_x);
    S_xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (S_xx == 0.0) return std::nullopt;
  Estimate slope{S_xy / S_xx, std::nullopt};
  if (n == 2) return slope;
  double residual = 0.0;  // sum of squares
  for (std::size_t i = 0; i < n; ++i) {
    const double r = y[i] - mean_y - slope.value * (x[i] - mean_x);
    residual += r * r;
  }
  const double half = student_quantile(n - 2) * std::sqrt(residual / static_cast<double>(n - 2) / S_xx);
  slope.interval = {slope.value - half, slope.value + half};
  return slope;
}

std::optional<double> median_of(std::vector<double> sample) {
  if (sample.empty()) return std::nullopt;
  std::ranges::sort(sample);
  const std::size_t middle = sample.size() / 2;
  return sample.size() % 2 == 1 ? sample[middle] : 0.5 * (sample[middle - 1] + sample[middle]);
}

}  // namespace harness
