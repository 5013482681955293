// Figures as values. A page shows them, and gnuplot draws them to files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "harness/figures/palette.hpp"

namespace harness {

/// Breaks a line.
inline constexpr double gap = std::numeric_limits<double>::quiet_NaN();

enum class Mark { line, thin_line, points, circles, crosses };

/// Curves with the same name belong together: they share one entry in the legend.
struct FigureCurve {
  std::string name = {};
  Rgb colour = palette::truth;
  Mark mark = Mark::line;
  std::vector<double> x = {};
  std::vector<double> y = {};  // same length as x
  bool is_hidden = false;      // until the reader switches it on; never drawn by gnuplot
};

struct FigureAxis {
  std::string label = {};
  bool is_logarithmic = false;  // values that are not positive are left out then
};

/// A horizontal band over the whole width.
struct Band {
  std::string label = {};
  double low = 0.0;
  double high = 0.0;
};

struct Figure {
  std::string id = {};  // letters, digits and '-'; also the name of the files
  std::string title = {};
  std::string caption = {};
  FigureAxis x = {};
  FigureAxis y = {};
  bool is_map = false;                       // equal scales on both axes
  std::vector<Band> bands = {};              // horizontal
  std::vector<std::string> categories = {};  // names of x = 0, 1, 2, ..; empty: x is a number
  std::vector<FigureCurve> curves = {};
};

/// A symmetric matrix as a picture.
struct MatrixFigure {
  std::string id = {};
  std::string title = {};
  std::string caption = {};
  std::size_t size = 0;                  // [-] cells along an edge
  std::vector<std::uint8_t> cells = {};  // (size x size) 0: zero; otherwise the darkness
};

/// The figure as the script of the page reads it.
std::string to_json(const Figure& figure);
std::string to_json(const MatrixFigure& figure);

}  // namespace harness
