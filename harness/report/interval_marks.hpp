// Confidence intervals in plots.
#pragma once

#include "harness/figures/figure.hpp"
#include "harness/statistics/statistics.hpp"

namespace harness {

/// Adds a vertical line with a short cap at both ends.
void add_interval(double x, const ConfidenceInterval& interval, FigureCurve& curve);

}  // namespace harness
