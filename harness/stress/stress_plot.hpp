// The time of each stage against the number of landmarks, as a picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/figures/figure.hpp"
#include "harness/stress/scaling.hpp"

namespace harness {

/// Median times, on logarithmic axes.
Figure scaling_figure(const std::vector<StageScaling>& stages);

/// Draws it as time.png and time.svg in this folder, with gnuplot. What went wrong, or nothing. There is
/// nothing to draw for a single number of landmarks.
std::string draw_scaling(const std::vector<StageScaling>& stages, const std::filesystem::path& folder);

}  // namespace harness
