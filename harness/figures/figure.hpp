// Figures as values. A page shows them, and gnuplot draws them to files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/figures/palette.hpp"

namespace harness {

/// Breaks a line.
inline constexpr double gap = std::numeric_limits<double>::quiet_NaN();

enum class Mark { line, thin_line, points, circles, crosses };

/// What a reader who points at the landmarks of a curve is told of them. All lists are as long as the curve; a
/// number that is not known is NaN.
struct LandmarkTips {
  std::vector<std::int64_t> id = {};  // negative: the world has no such landmark
  std::vector<double> true_x = {};    // [m]
  std::vector<double> true_y = {};    // [m]
  std::vector<double> sd_x = {};      // [m] standard deviation that the filter believes
  std::vector<double> sd_y = {};      // [m]
};

/// Curves with the same name belong together: they share one entry in the legend.
struct FigureCurve {
  std::string name = {};
  Rgb colour = palette::truth;
  Mark mark = Mark::line;
  std::vector<double> x = {};
  std::vector<double> y = {};  // same length as x
  bool is_hidden = false;      // until the reader switches it on; never drawn by gnuplot
  bool is_silent = false;      // it says nothing to a reader who points at it
  std::optional<LandmarkTips> landmarks = {};
};

struct FigureAxis {
  std::string label = {};
  bool is_logarithmic = false;  // values that are not positive are left out then
};

/// A closed polygon of a map, below its curves.
struct FigureArea {
  bool is_solid = true;        // it blocks the robot; otherwise other ground
  std::vector<double> x = {};  // [m]
  std::vector<double> y = {};  // [m] same length as x
};

/// Round solid things of a map.
struct FigureDiscs {
  std::vector<double> x = {};       // [m]
  std::vector<double> y = {};       // [m] same length as x
  std::vector<double> radius = {};  // [m] same length as x
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
  std::vector<FigureArea> areas = {};
  FigureDiscs discs = {};
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
