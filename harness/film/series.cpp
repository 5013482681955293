#include "harness/film/series.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace harness {

namespace {

constexpr std::size_t most_in_a_bin = 31;  // [-]

}  // namespace

Series::Series(double start, double end, int bins)
    : start_(start), end_(end), values_(static_cast<std::size_t>(bins)) {}

void Series::add(double t, double value) {
  if (!std::isfinite(value)) return;
  last_ = value;
  const double position = (t - start_) / (end_ - start_) * bins();
  const int bin = std::clamp(static_cast<int>(std::floor(position)), 0, bins() - 1);
  std::vector<double>& values = values_[static_cast<std::size_t>(bin)];
  if (values.size() < most_in_a_bin) values.insert(std::ranges::upper_bound(values, value), value);
}

double Series::time_of(int bin) const { return start_ + (bin + 0.5) * (end_ - start_) / bins(); }

std::optional<double> Series::value(int bin) const {
  const std::vector<double>& values = values_[static_cast<std::size_t>(bin)];
  if (values.empty()) return std::nullopt;
  return values[values.size() / 2];
}

std::optional<double> Series::smallest() const {
  std::optional<double> result;
  for (int bin = 0; bin < bins(); ++bin) {
    if (const std::optional<double> median = value(bin)) result = std::min(*median, result.value_or(*median));
  }
  return result;
}

std::optional<double> Series::largest() const {
  std::optional<double> result;
  for (int bin = 0; bin < bins(); ++bin) {
    if (const std::optional<double> median = value(bin)) result = std::max(*median, result.value_or(*median));
  }
  return result;
}

}  // namespace harness
