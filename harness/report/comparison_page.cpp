// The pages of a comparison and of the repeated report: estimators side by side, with intervals.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/comparison/comparison_keys.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/files/row_reader.hpp"
#include "harness/paper/paper_report.hpp"
#include "harness/report/interval_marks.hpp"
#include "harness/report/pages.hpp"
#include "harness/report/run_figures.hpp"
#include "harness/report/world_facts.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

struct ComparedValue {
  std::optional<Estimate> EstimatorComparison::*member;
  const char* id;
  const char* title;
  FigureAxis axis;
};

const ComparedValue compared_values[] = {
    {&EstimatorComparison::landmark_mse, "mse", "Squared error of the map", {"mean [m^2]", true}},
    {&EstimatorComparison::landmark_aligned, "aligned", "Error of the map, aligned", {"mean RMSE [m]", true}},
    {&EstimatorComparison::aligned_ratio,
     "ratio",
     "Error of the map, aligned, over the baseline's",
     {"ratio [-]", true}},
    {&EstimatorComparison::nees_pose, "nees-pose", "NEES of the pose at the end", {"mean NEES [-]", true}},
    {&EstimatorComparison::nees_landmark, "nees-map", "NEES of the map at the end", {"mean NEES [-]", true}},
    {&EstimatorComparison::nees_from_robot,
     "nees-from-robot",
     "NEES of landmarks as seen from the robot",
     {"mean NEES [-]", true}},
    {&EstimatorComparison::nis_scan, "nis", "NIS of whole scans", {"mean NIS [-]"}},
    {&EstimatorComparison::links, "links", "Links at the end", {"mean links [-]", true}}};

std::vector<Drawn> drawn_of(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const EstimatorComparison& estimator : comparison.estimators) names.push_back(estimator.name);
  return drawn(names, names);
}

/// A mean with its interval for each estimator, side by side.
Figure value_figure(const Comparison& comparison, const ComparedValue& value) {
  Figure figure{.id = value.id, .title = value.title, .x = {"estimator"}, .y = value.axis};
  figure.caption = "Over the runs that an estimator finished, with 95 % confidence intervals.";
  const std::vector<Drawn> estimators = drawn_of(comparison);
  for (std::size_t i = 0; i < estimators.size(); ++i) {
    figure.categories.push_back(estimators[i].name);
    const std::optional<Estimate>& estimate = comparison.estimators[i].*value.member;
    if (!estimate) continue;
    const auto x = static_cast<double>(i);
    figure.curves.push_back({estimators[i].name, estimators[i].colour, Mark::points, {x}, {estimate->value}});
    FigureCurve interval{estimators[i].name, estimators[i].colour, Mark::line};
    if (estimate->interval) add_interval(x, *estimate->interval, interval);
    if (!interval.x.empty()) figure.curves.push_back(std::move(interval));
  }
  return figure;
}

/// The error of each run: `error(run, estimator)` gives it, if it is known.
Figure runs_figure(const Comparison& comparison, std::size_t runs,
                   const std::function<std::optional<double>(std::size_t, const std::string&)>& error) {
  Figure figure{
      .id = "runs", .title = "Error of the map in each run, aligned", .x = {"run"}, .y = {"RMSE [m]", true}};
  figure.caption = "The runs in their order, from 1 on.";
  for (const Drawn& estimator : drawn_of(comparison)) {
    FigureCurve curve{estimator.name, estimator.colour, Mark::points};
    for (std::size_t i = 0; i < runs; ++i) {
      const std::optional<double> value = error(i, estimator.name);
      if (!value) continue;
      curve.x.push_back(static_cast<double>(i + 1));
      curve.y.push_back(*value);
    }
    if (!curve.x.empty()) figure.curves.push_back(std::move(curve));
  }
  return figure;
}

void add_value_figures(const Comparison& comparison, Page& page) {
  for (const ComparedValue& value : compared_values) {
    Figure figure = value_figure(comparison, value);
    if (!figure.curves.empty()) page.figures.push_back(std::move(figure));
  }
}

void add_listing(const std::string& title, const std::filesystem::path& file, Page& page) {
  if (std::filesystem::exists(file)) page.listings.push_back({title, read_whole_file(file)});
}

/// Makes a page from the text of a file; what is wrong with the text is told with the name of the file.
Page page_from(const std::filesystem::path& file, const std::function<Page(const std::string&)>& make) {
  const std::string text = read_whole_file(file);
  try {
    return make(text);
  } catch (const Json::exception& error) {
    throw BadInput(fmt::format("{}: is no result of a comparison: {}", file.string(), error.what()));
  }
}

Page page_of_comparison(const std::filesystem::path& folder, const std::string& text) {
  const Comparison comparison = parse_comparison(text);
  const Json json = Json::parse(text);
  Page page;
  page.title = "Comparison, " + comparison.name;
  std::vector<std::string> names;
  for (const ComparedRun& run : comparison.runs) names.push_back(run.name);
  page.facts = {{"World or logs", comparison.name},
                {"Runs", fmt::format("{}", comparison.runs.size())},
                {"Baseline", comparison.baseline},
                {"Made by version", json.at("version").get<std::string>()}};
  if (comparison.interrupted) page.facts.push_back({"Interrupted", "before its end"});
  page.notes = failures_of(comparison);
  const std::vector<std::vector<TextRow>> tables = comparison_tables(comparison);
  page.tables = {{"Error of the map", tables[0],
                  fmt::format("Over {0}: the ratio to {0}'s in the same runs.", comparison.baseline)},
                 {"Consistency at the end", tables[1], "NEES and NIS: 1 is right, more is overconfident."},
                 {"Map and cost", tables[2]}};
  if (tables.size() > 3) page.tables.push_back({"Lost and found again", tables[3]});
  Figure runs = runs_figure(comparison, comparison.runs.size(),
                            [&](std::size_t run, const std::string& name) -> std::optional<double> {
                              const Json& estimators = json.at("runs").at(run).at("summary").at("estimators");
                              if (!estimators.contains(name)) return std::nullopt;
                              const Json& value = estimators.at(name).at("landmark_rmse_aligned_m");
                              return value.is_null() ? std::nullopt : std::optional(value.get<double>());
                            });
  add_value_figures(comparison, page);
  if (!runs.curves.empty()) page.figures.push_back(std::move(runs));
  page.listings.push_back({"The runs", fmt::format("{}\n", fmt::join(names, "\n"))});
  add_listing("As printed, with the meaning of the columns (comparison.txt)", folder / "comparison.txt",
              page);
  return page;
}

/// The aligned errors of runs.csv, in the order of the runs.
struct PaperRuns {
  std::vector<std::string> names;
  std::map<std::pair<std::size_t, std::string>, double> errors;  // [m] by run and estimator
};

PaperRuns read_paper_runs(const std::filesystem::path& file) {
  PaperRuns runs;
  if (!std::filesystem::exists(file)) return runs;
  RowReader rows(file, ',');
  if (!rows.next()) return runs;  // the header: run, estimator, RMSE, aligned RMSE, ...
  while (rows.next()) {
    const std::string name(rows.cell(0));
    if (runs.names.empty() || runs.names.back() != name) runs.names.push_back(name);
    if (rows.cell(3).empty()) continue;
    const std::pair key(runs.names.size() - 1, std::string(rows.cell(1)));
    runs.errors[key] = rows.number(3, "landmark_rmse_aligned_m");
  }
  return runs;
}

constexpr std::array<std::array<const char*, 3>, 3> paper_images = {
    {{"figure1.svg", "Figure 1: the EKF",
      "Map with errors and ellipses, correlations, and the normalised information matrix."},
     {"figure2.svg", "Figure 2: a sparse filter",
      "The normalised information matrix of a sparse filter, and the network of its links."},
     {"figure6.svg", "Figure 6: the filters side by side",
      "One row for each filter: map, links, correlations, normalised information."}}};

Page page_of_paper(const std::filesystem::path& folder, const seif::Registry& registry,
                   const std::string& text) {
  Comparison comparison = parse_comparison(text);
  const Json json = Json::parse(text);
  if (std::filesystem::exists(folder / "times.json")) {
    const Json times = Json::parse(read_whole_file(folder / "times.json"));
    for (EstimatorComparison& estimator : comparison.estimators) {
      if (times.at("estimators").contains(estimator.name))
        read_comparison_keys(times.at("estimators").at(estimator.name).dump(), estimator);
    }
  }
  Page page;
  page.title = "Section 4 of the 2002 report, " + comparison.name;
  page.facts = {{"World", comparison.name},
                {"Runs", json.at("runs").dump()},
                {"First seed", json.at("first_seed").dump()},
                {"Landmarks", json.at("landmarks").dump()},
                {"Engine", json.at("engine").get<std::string>()},
                {"Made by version", json.at("version").get<std::string>()}};
  if (comparison.interrupted) page.facts.push_back({"Interrupted", "before its end"});
  const std::vector<std::vector<TextRow>> tables = paper_tables(comparison);
  page.tables = {{"Final error", tables[0],
                  "The columns named report are those of the report. What each column means is said below, "
                  "with all that is printed."},
                 {"Links and time", tables[1]},
                 {"Consistency", tables[2], "NEES: 1 is right, more is overconfident."}};
  if (const std::optional<worlds::World> world = world_of(folder, registry))
    page.descriptions = {describe(*world), describe(world->estimators)};
  add_value_figures(comparison, page);
  const PaperRuns runs = read_paper_runs(folder / "runs.csv");
  Figure each = runs_figure(comparison, runs.names.size(),
                            [&](std::size_t run, const std::string& name) -> std::optional<double> {
                              const auto found = runs.errors.find({run, name});
                              return found == runs.errors.end() ? std::nullopt : std::optional(found->second);
                            });
  if (!each.curves.empty()) page.figures.push_back(std::move(each));
  for (const auto& [name, title, caption] : paper_images) {
    if (std::filesystem::exists(folder / name)) page.images.push_back({title, caption, folder / name});
  }
  add_listing("As printed, with the meaning of the columns (paper.txt)", folder / "paper.txt", page);
  add_listing("The world", folder / "world.yaml", page);
  return page;
}

}  // namespace

Page comparison_page(const std::filesystem::path& folder) {
  return page_from(folder / "comparison.json",
                   [&](const std::string& text) { return page_of_comparison(folder, text); });
}

Page paper_page(const std::filesystem::path& folder, const seif::Registry& registry) {
  return page_from(folder / "paper.json",
                   [&](const std::string& text) { return page_of_paper(folder, registry, text); });
}

}  // namespace harness
