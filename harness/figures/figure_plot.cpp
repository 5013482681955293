#include "harness/figures/figure_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "harness/figures/gnuplot.hpp"

namespace harness {

namespace {

/// The text in quotes, with control characters replaced by spaces.
std::string quoted(std::string text) {
  std::ranges::replace_if(
      text, [](char sign) { return sign >= 0 && sign < ' '; }, ' ');
  return gnuplot_text(text);
}

bool is_drawn(const Figure& figure, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && !(figure.x.is_logarithmic && x <= 0.0) &&
         !(figure.y.is_logarithmic && y <= 0.0);
}

/// One block of data for each curve. An empty line breaks a curve.
std::string data_of(const Figure& figure) {
  std::string text;
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const FigureCurve& curve = figure.curves[i];
    fmt::format_to(std::back_inserter(text), "$curve{} << EOD\n", i);
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      is_drawn(figure, curve.x[k], curve.y[k])
          ? void(fmt::format_to(std::back_inserter(text), "{} {}\n", curve.x[k], curve.y[k]))
          : void(text += '\n');
    }
    text += "EOD\n";
  }
  return text;
}

/// Walls and the like: a block of polygons for each kind, and one of discs.
std::string data_of_areas(const Figure& figure) {
  std::string text;
  for (const bool is_solid : {false, true}) {
    text += is_solid ? "$solids << EOD\n" : "$patches << EOD\n";
    for (const FigureArea& area : figure.areas) {
      if (area.is_solid != is_solid) continue;
      for (std::size_t i = 0; i < area.x.size(); ++i)
        fmt::format_to(std::back_inserter(text), "{} {}\n", area.x[i], area.y[i]);
      text += '\n';
    }
    text += "EOD\n";
  }
  text += "$discs << EOD\n";
  for (std::size_t i = 0; i < figure.discs.x.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", figure.discs.x[i], figure.discs.y[i],
                   figure.discs.radius[i]);
  return text + "EOD\n";
}

/// What lies below the curves, each part with a comma behind it.
std::string plot_of_areas(const Figure& figure) {
  const auto has = [&](bool is_solid) {
    return std::ranges::find(figure.areas, is_solid, &FigureArea::is_solid) != figure.areas.end();
  };
  std::string text;
  if (has(false)) text += "$patches with filledcurves closed fs solid noborder lc rgb '#eadfc8' notitle, ";
  if (has(true)) text += "$solids with filledcurves closed fs solid noborder lc rgb '#aab2b9' notitle, ";
  if (!figure.discs.x.empty()) text += "$discs with circles fs solid noborder lc rgb '#aab2b9' notitle, ";
  return text;
}

constexpr const char* style_of(Mark mark) {
  switch (mark) {
    case Mark::line:
      return "lines lw 2";
    case Mark::thin_line:
      return "lines lw 1";
    case Mark::points:
      return "points pt 7 ps 0.6";
    case Mark::circles:
      return "points pt 6 ps 1.1";
    case Mark::crosses:
      return "points pt 2 ps 0.7";
  }
  return "";
}

std::string categories_of(const Figure& figure) {
  std::string tics;
  for (std::size_t i = 0; i < figure.categories.size(); ++i)
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", quoted(figure.categories[i]), i);
  return fmt::format("set xtics ({}) noenhanced rotate by -20\nset xrange [-0.5:{}]\n", tics,
                     static_cast<double>(figure.categories.size()) - 0.5);
}

std::string settings_of(const Figure& figure) {
  std::string text = fmt::format(
      "set grid lc '#e6e6e6' lt 1\nset border lc '#888888'\nset key outside right noenhanced\n"
      "set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n",
      quoted(figure.title), quoted(figure.x.label), quoted(figure.y.label));
  if (figure.x.is_logarithmic) text += "set logscale x\nset format x '%.0f'\n";
  if (figure.y.is_logarithmic) text += "set logscale y\n";
  if (figure.is_map) text += "set size ratio -1\n";
  if (!figure.categories.empty()) text += categories_of(figure);
  for (const Band& band : figure.bands) {
    text += fmt::format(
        "set object rectangle from graph 0, first {} to graph 1, first {} fc rgb '#808080' fs transparent "
        "solid "
        "0.2 noborder behind\n",
        band.low, band.high);
  }
  return text;
}

std::string plot_of(const Figure& figure) {
  std::string text = settings_of(figure) + "plot " + plot_of_areas(figure);
  std::set<std::string> named;
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const FigureCurve& curve = figure.curves[i];
    const std::string title = named.insert(curve.name).second ? "title " + quoted(curve.name) : "notitle";
    text += fmt::format("{}$curve{} with {} lc rgb {} {}", i == 0 ? "" : ", ", i, style_of(curve.mark),
                        gnuplot_colour(curve.colour), title);
  }
  return text + '\n';
}

}  // namespace

std::string draw(const Figure& figure, const std::filesystem::path& folder) {
  Figure shown = figure;
  std::erase_if(shown.curves, [](const FigureCurve& curve) { return curve.is_hidden; });
  return draw_picture({.name = figure.id,
                       .width = 1000,
                       .height = figure.is_map ? 800 : 640,
                       .settings = data_of(shown) + data_of_areas(shown),
                       .plot = plot_of(shown)},
                      folder);
}

std::string draw(const MatrixFigure& figure, const std::filesystem::path& folder) {
  std::string data = "$matrix << EOD\n";
  for (std::size_t row = 0; row < figure.size; ++row) {
    for (std::size_t column = 0; column < figure.size; ++column)
      fmt::format_to(std::back_inserter(data), "{} ", figure.cells[row * figure.size + column]);
    data += '\n';
  }
  data += "EOD\n";
  const std::string plot = fmt::format(
      "set title {} noenhanced\nset size ratio -1\nunset key\nunset tics\nunset colorbox\n"
      "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset cbrange [0:255]\n"
      "set palette defined (0 'white', 255 '#0f1a29')\nplot $matrix matrix with image pixels\n",
      quoted(figure.title), static_cast<double>(figure.size) - 0.5, static_cast<double>(figure.size) - 0.5);
  return draw_picture({.name = figure.id, .width = 640, .height = 680, .settings = data, .plot = plot},
                      folder);
}

}  // namespace harness
