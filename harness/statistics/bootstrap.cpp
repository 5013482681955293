#include "harness/statistics/bootstrap.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace harness {

namespace {

constexpr std::size_t resamples = 4000;

double average(std::span<const double> sample) {
  return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
}

/// Means of samples drawn with replacement, ascending.
std::vector<double> resampled_means(std::span<const double> sample) {
  std::mt19937_64 random;  // the standard defines its seed and its numbers
  std::vector<double> means(resamples);
  for (double& mean : means) {
    double sum = 0.0;
    for (std::size_t i = 0; i < sample.size(); ++i) {
      const std::uint64_t bits = random() >> 32U;
      sum += sample[(bits * sample.size()) >> 32U];
    }
    mean = sum / static_cast<double>(sample.size());
  }
  std::ranges::sort(means);
  return means;
}

/// The normal quantile of the share of `means` below the sample's mean; those that are equal count half.
double bias_correction(std::span<const double> means, double mean) {
  const auto equal = std::ranges::equal_range(means, mean);
  const auto before = static_cast<double>(equal.begin() - means.begin());
  const double below = before + 0.5 * static_cast<double>(equal.size());
  const auto n = static_cast<double>(means.size());
  return boost::math::quantile(boost::math::normal(), std::clamp(below / n, 0.5 / n, 1.0 - 0.5 / n));
}

/// A sixth of the skewness of the mean; the jackknife gives the same.
double acceleration(std::span<const double> sample, double mean) {
  double squares = 0.0;
  double cubes = 0.0;
  for (const double value : sample) {
    const double deviation = value - mean;
    squares += deviation * deviation;
    cubes += deviation * deviation * deviation;
  }
  return cubes / (6.0 * squares * std::sqrt(squares));
}

double quantile_of(std::span<const double> ascending, double level) {
  const double position = level * static_cast<double>(ascending.size());
  return ascending[std::min(static_cast<std::size_t>(position), ascending.size() - 1)];
}

}  // namespace

BcaLevels bca_levels(double bias_correction, double acceleration, double half_width) {
  const auto level = [&](double end) {
    const double z = bias_correction + end;
    const double denominator = 1.0 - acceleration * z;
    if (denominator <= 0.0) return z > 0.0 ? 1.0 : 0.0;
    return boost::math::cdf(boost::math::normal(), bias_correction + z / denominator);
  };
  return {level(-half_width), level(half_width)};
}

ConfidenceInterval bca_interval_of_mean(std::span<const double> sample, double half_width) {
  // In units of the largest value, so that the squares of tiny and of huge values neither vanish nor overflow.
  const double unit = std::abs(*std::ranges::max_element(sample, {}, [](double x) { return std::abs(x); }));
  std::vector<double> scaled(sample.begin(), sample.end());
  for (double& value : scaled) value /= unit;
  const double mean = average(scaled);
  const std::vector<double> means = resampled_means(scaled);
  const BcaLevels levels = bca_levels(bias_correction(means, mean), acceleration(scaled, mean), half_width);
  return {unit * quantile_of(means, levels.low), unit * quantile_of(means, levels.high)};
}

}  // namespace harness
