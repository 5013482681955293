// A plot of the time of each stage over the number of landmarks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/figures/figure.hpp"
#include "harness/stress/scaling.hpp"

namespace harness {

/// The median times on logarithmic axes.
Figure scaling_figure(const std::vector<StageScaling>& stages);

/// Draws the plot as time.png and time.svg in this folder, with gnuplot. Returns an error message, or
/// nothing. A single number of landmarks gives no plot.
std::string draw_scaling(const std::vector<StageScaling>& stages, const std::filesystem::path& folder);

}  // namespace harness
