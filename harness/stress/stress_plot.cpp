#include "harness/stress/stress_plot.hpp"

#include <algorithm>
#include <vector>

#include "harness/figures/figure_plot.hpp"
#include "harness/figures/palette.hpp"

namespace harness {

namespace {

Rgb colour_of(const std::string& stage) {
  if (stage == "physics step") return palette::sky_blue;
  if (stage == "scan") return palette::orange;
  if (stage == "rest") return palette::odometry;
  if (stage == "simulated second") return palette::truth;
  return colour_of_estimator(stage);
}

}  // namespace

Figure scaling_figure(const std::vector<StageScaling>& stages) {
  Figure figure;
  figure.id = "time";
  figure.title = "Time against the number of landmarks";
  figure.caption = "Medians of what was measured live, after a warm start. A flat line is constant time.";
  figure.x = {"landmarks", true};
  figure.y = {"median time [us]", true};
  for (const StageScaling& stage : stages) {
    figure.curves.push_back({stage.name, colour_of(stage.name), Mark::line, stage.landmarks, stage.us});
    figure.curves.push_back({stage.name, colour_of(stage.name), Mark::points, stage.landmarks, stage.us});
  }
  return figure;
}

std::string draw_scaling(const std::vector<StageScaling>& stages, const std::filesystem::path& folder) {
  if (std::ranges::none_of(stages, [](const StageScaling& s) { return s.us.size() > 1; })) return {};
  return draw(scaling_figure(stages), folder);
}

}  // namespace harness
