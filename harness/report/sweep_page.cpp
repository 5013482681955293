#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/comparison/seeds.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/report/interval_marks.hpp"
#include "harness/report/pages.hpp"
#include "harness/report/run_figures.hpp"
#include "harness/sweep/status.hpp"
#include "harness/sweep/sweep.hpp"

namespace harness {

namespace {

struct PlottedScore {
  const char* name;
  const char* id;
  const char* title;
  FigureAxis axis;
};

const PlottedScore plotted[] = {
    {"landmark_rmse_aligned_m", "aligned", "Error of the map, aligned", {"mean RMSE [m]"}},
    {"ate_rmse_m", "ate", "Error of the trajectory", {"mean ATE [m]"}},
    {"nees_pose_final", "nees-pose", "NEES of the pose at the end", {"mean NEES [-]", true}},
    {"nees_landmark_final", "nees-map", "NEES of the map at the end", {"mean NEES [-]", true}},
    {"nees_landmark_from_robot_final",
     "nees-from-robot",
     "NEES of landmarks as seen from the robot",
     {"mean NEES [-]", true}},
    {"nis_scan", "nis", "NIS of whole scans", {"mean NIS [-]"}},
    {"links", "links", "Links at the end", {"mean links [-]"}},
    {"memory_bytes", "memory", "Memory of the filter at the end", {"mean memory [byte]", true}}};

std::string paths_of(const SweepPlan& plan) {
  std::vector<std::string> paths;
  for (const SweepAxis& axis : plan.axes) paths.push_back(axis.path);
  return fmt::format("{}", fmt::join(paths, ", "));
}

std::vector<Drawn> estimators_of(const Aggregate& aggregate) {
  std::vector<std::string> names;
  for (const SettingStatistics& setting : aggregate.settings) {
    for (const EstimatorStatistics& estimator : setting.estimators) {
      if (std::ranges::find(names, estimator.name) == names.end() && estimator.name != "odometry")
        names.push_back(estimator.name);
    }
  }
  return drawn(names, names);
}

/// The means of a score over the settings. The estimators are drawn slightly beside each other.
Figure intervals_of(const Aggregate& aggregate, const PlottedScore& score,
                    const std::vector<Drawn>& estimators) {
  Figure figure{.id = score.id, .title = score.title, .y = score.axis};
  figure.x.label = fmt::format("{}", fmt::join(short_paths(aggregate.plan), ", "));
  figure.caption =
      "Means over the seeds with their 95 % confidence intervals (BCa bootstrap; docs/sweeps.md).";
  for (const SettingStatistics& setting : aggregate.settings)
    figure.categories.push_back(setting.values.empty() ? "all seeds"
                                                       : fmt::format("{}", fmt::join(setting.values, ", ")));
  const auto count = static_cast<double>(estimators.size());
  for (std::size_t k = 0; k < estimators.size(); ++k) {
    const double aside = 0.6 * (static_cast<double>(k) - 0.5 * (count - 1.0)) / count;
    FigureCurve means{estimators[k].name, estimators[k].colour, Mark::points, {}, {}};
    FigureCurve intervals{estimators[k].name, estimators[k].colour, Mark::line, {}, {}};
    for (std::size_t i = 0; i < aggregate.settings.size(); ++i) {
      const auto& all = aggregate.settings[i].estimators;
      const auto estimator = std::ranges::find(all, estimators[k].name, &EstimatorStatistics::name);
      const ScoreStatistics* found = estimator == all.end() ? nullptr : estimator->find(score.name);
      if (found == nullptr) continue;
      const double x = static_cast<double>(i) + aside;
      means.x.push_back(x);
      means.y.push_back(found->mean.value);
      if (found->mean.interval) add_interval(x, *found->mean.interval, intervals);
    }
    if (means.x.empty()) continue;
    figure.curves.push_back(std::move(means));
    figure.curves.push_back(std::move(intervals));
  }
  return figure;
}

}  // namespace

Page sweep_page(const std::filesystem::path& folder) {
  const SweepFolder sweep = open_sweep(folder);
  if (status_of(sweep).open > 0)
    throw BadInput(
        fmt::format("{}: some runs of the sweep are still open; seifbed sweep --resume {} does them",
                    folder.string(), folder.string()));
  const Aggregate aggregate = read_aggregate(sweep);
  const SweepPlan& plan = sweep.plan;
  Page page;
  page.title = fmt::format("Sweep of {}", plan.name);
  page.facts = {{"World", plan.name},
                {"Seeds", seeds_text(plan.seeds)},
                {"Settings", fmt::format("{}", setting_count(plan))},
                {"Runs", fmt::format("{}", cell_count(plan))},
                {"Failed", fmt::format("{}", aggregate.failed.size())},
                {"Baseline", plan.baseline},
                {"Made by version", plan.version}};
  page.tables = {
      {"Means over the seeds", aggregate_table(aggregate),
       fmt::format("{}The column less {}'s is the 95 % interval of the difference in the same run: where it "
                   "does not hold zero, the two differ.",
                   plan.axes.empty() ? "" : fmt::format("Varied: {}. ", paths_of(plan)), plan.baseline)}};
  const std::vector<Drawn> estimators = estimators_of(aggregate);
  for (const PlottedScore& score : plotted) {
    Figure figure = intervals_of(aggregate, score, estimators);
    if (!figure.curves.empty()) page.figures.push_back(std::move(figure));
  }
  if (!aggregate.failed.empty())
    page.listings.push_back({"What failed", failed_lines(plan, aggregate.failed)});
  page.listings.push_back({"All scores (aggregate.csv)", to_csv(aggregate)});
  page.listings.push_back({"The world", read_whole_file(sweep.world())});
  return page;
}

}  // namespace harness
