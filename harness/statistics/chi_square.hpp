// Chi-square bands of normalised errors, and the share of values inside a band.
#pragma once

#include <optional>
#include <span>

#include "harness/statistics/statistics.hpp"

namespace harness {

/// The band of 95 % of a consistent filter's NEES per degree of freedom, with 2.5 % on either side: quantiles
/// of the chi-square distribution with `degrees` degrees of freedom, divided by `degrees`. [-]
ConfidenceInterval chi_square_band(int degrees);

/// The share of the values inside a band; empty if there are no values. [-]
std::optional<double> share_inside(std::span<const double> values, const ConfidenceInterval& band);

}  // namespace harness
