// Figures for papers: PNG and SVG, by gnuplot.
#pragma once

#include <filesystem>
#include <string>

#include "harness/figures/figure.hpp"

namespace harness {

/// Draws ID.png and ID.svg into an existing folder. Returns what went wrong, or nothing.
std::string draw(const Figure& figure, const std::filesystem::path& folder);
std::string draw(const MatrixFigure& figure, const std::filesystem::path& folder);

}  // namespace harness
