#include "harness/stress/stress_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "harness/gnuplot.hpp"
#include "harness/palette.hpp"

namespace harness {

namespace {

constexpr const char* settings =
    "set logscale xy\nset format x '%.0f'\nset grid lc '#e6e6e6' lt 1\nset border lc '#888888'\n"
    "set key outside right\nset xlabel 'landmarks'\nset ylabel 'median time [us]'\n";

Rgb colour_of(const std::string& stage) {
  if (stage == "physics step") return palette::sky_blue;
  if (stage == "scan") return palette::orange;
  if (stage == "rest") return palette::odometry;
  if (stage == "simulated second") return palette::truth;
  return colour_of_estimator(stage);
}

std::string data_of(const std::vector<StageScaling>& stages) {
  std::string text;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "$stage{} << EOD\n", i);
    for (std::size_t k = 0; k < stages[i].us.size(); ++k)
      fmt::format_to(std::back_inserter(text), "{} {}\n", stages[i].landmarks[k], stages[i].us[k]);
    text += "EOD\n";
  }
  return text;
}

std::string plot_of(const std::vector<StageScaling>& stages) {
  std::string text = "plot ";
  for (std::size_t i = 0; i < stages.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{}$stage{} with linespoints pt 7 lw 2 lc rgb {} title {}",
                   i == 0 ? "" : ", ", i, gnuplot_colour(colour_of(stages[i].name)),
                   gnuplot_text(stages[i].name));
  }
  return text + " noenhanced\n";
}

}  // namespace

std::string draw_scaling(const std::vector<StageScaling>& stages, const std::filesystem::path& folder) {
  if (std::ranges::none_of(stages, [](const StageScaling& s) { return s.us.size() > 1; })) return {};
  return draw_picture({.name = "time",
                       .width = 1000,
                       .height = 640,
                       .settings = data_of(stages) + settings,
                       .plot = plot_of(stages)},
                      folder);
}

}  // namespace harness
