#include "harness/statistics/divergence.hpp"

#include <algorithm>
#include <cmath>

namespace harness {

double highest_nis(int degrees) {
  constexpr double z = 5.998;  // quantile of the standard normal distribution at 1 - 1e-9
  const double c = 2.0 / (9.0 * degrees);
  const double root = 1.0 - c + z * std::sqrt(c);
  return tolerated_sigma * tolerated_sigma * root * root * root;
}

double highest_nees_pose() {
  constexpr double chi_square_3 = 30.66;  // chi-square quantile, 3 degrees of freedom, at 1 - 1e-6
  return chi_square_3 / 3.0;
}

void InnovationTest::add(double t, double innovation, int degrees, std::int64_t gated) {
  if (degrees == 0 && gated == 0) return;
  scans_[added_++ % window] = {innovation, degrees, gated};
  if (added_ < window) return;
  ScanSum sum;
  for (const ScanSum& scan : scans_) {
    sum.innovation += scan.innovation;
    sum.degrees += scan.degrees;
    sum.gated += scan.gated;
  }
  const double nis = sum.degrees > 0 ? sum.innovation / sum.degrees : 0.0;
  worst_ = std::max(worst_.value_or(0.0), nis);
  const bool too_far = sum.degrees > 0 && !(nis <= highest_nis(sum.degrees));
  const bool shut_out = 2 * sum.gated > sum.degrees;
  if ((too_far || shut_out) && !fired_t_) fired_t_ = t;
}

}  // namespace harness
