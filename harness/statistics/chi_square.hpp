// Chi-square bands of normalised errors, and the share of values inside.
#pragma once

#include <optional>
#include <span>

#include "harness/statistics/statistics.hpp"

namespace harness {

/// The band that holds 95 % of the NEES per degree of freedom of a consistent filter, with 2.5 % on either side:
/// quantiles of the chi-square distribution with `degrees` degrees of freedom, divided by `degrees`. [-]
ConfidenceInterval chi_square_band(int degrees);

/// The share of the values that lie in a band; nothing without values. [-]
std::optional<double> share_inside(std::span<const double> values, const ConfidenceInterval& band);

}  // namespace harness
