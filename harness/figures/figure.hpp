// Figures as values: a page shows them, gnuplot prints them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "harness/figures/palette.hpp"

namespace harness {

/// What breaks a line.
inline constexpr double gap = std::numeric_limits<double>::quiet_NaN();

enum class Mark { line, thin_line, points, circles, crosses };

/// Curves of one name in a figure belong together: they have one entry in its legend.
struct FigureCurve {
  std::string name = {};
  Rgb colour = palette::truth;
  Mark mark = Mark::line;
  std::vector<double> x = {};
  std::vector<double> y = {};  // as many
  bool is_hidden = false;      // until it is asked for; not on paper
};

struct FigureAxis {
  std::string label = {};
  bool is_logarithmic = false;  // values that are not above zero are ignored then
};

/// A strip over the whole width.
struct Band {
  std::string label = {};
  double low = 0.0;
  double high = 0.0;
};

struct Figure {
  std::string id = {};  // letters, digits and '-': also the name of its files
  std::string title = {};
  std::string caption = {};
  FigureAxis x = {};
  FigureAxis y = {};
  bool is_map = false;                       // metres are as long along both axes
  std::vector<Band> bands = {};              // along x
  std::vector<std::string> categories = {};  // names of x = 0, 1, 2, ..; empty: x is a number
  std::vector<FigureCurve> curves = {};
};

/// A symmetric matrix as a picture.
struct MatrixFigure {
  std::string id = {};
  std::string title = {};
  std::string caption = {};
  std::size_t size = 0;                  // [-] cells along an edge
  std::vector<std::uint8_t> cells = {};  // (size x size) 0: zero; else how dark
};

/// As the script of the page reads it.
std::string to_json(const Figure& figure);
std::string to_json(const MatrixFigure& figure);

}  // namespace harness
