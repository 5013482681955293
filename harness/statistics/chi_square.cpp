#include "harness/statistics/chi_square.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>

namespace harness {

ConfidenceInterval chi_square_band(int degrees) {
  const boost::math::chi_squared distribution(degrees);
  return {boost::math::quantile(distribution, 0.025) / degrees,
          boost::math::quantile(distribution, 0.975) / degrees};
}

std::optional<double> share_inside(std::span<const double> values, const ConfidenceInterval& band) {
  if (values.empty()) return std::nullopt;
  const auto inside =
      std::ranges::count_if(values, [&](double value) { return value >= band.low && value <= band.high; });
  return static_cast<double>(inside) / static_cast<double>(values.size());
}

}  // namespace harness
