// Figures for papers, as PNG and SVG files drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>

#include "harness/figures/figure.hpp"

namespace harness {

/// Draws `ID.png` and `ID.svg` in an existing folder. Returns an error message, or nothing.
std::string draw(const Figure& figure, const std::filesystem::path& folder);
std::string draw(const MatrixFigure& figure, const std::filesystem::path& folder);

}  // namespace harness
