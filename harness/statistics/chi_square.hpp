// Chi-square bands of normalised errors, and the share of values inside a band.
#pragma once

#include <optional>
#include <span>

#include "harness/statistics/statistics.hpp"

namespace harness {

/// The central 95 % band of the NEES per degree of freedom of a consistent filter: the 2.5 % and 97.5 %
/// quantiles of the chi-square distribution with `degrees` degrees of freedom, divided by `degrees`. [-]
ConfidenceInterval chi_square_band(int degrees);

/// The share of the values that lie in the band; empty if there are no values. [-]
std::optional<double> share_inside(std::span<const double> values, const ConfidenceInterval& band);

}  // namespace harness
