#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/film/matrix_picture.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/report/pages.hpp"
#include "harness/report/run_figures.hpp"
#include "harness/report/world_facts.hpp"
#include "harness/run/rebuilding.hpp"
#include "harness/run/replay_settings.hpp"
#include "harness/score/details.hpp"
#include "harness/score/scoreboard.hpp"
#include "harness/stream/log_description.hpp"

namespace harness {

namespace {

std::vector<std::string> names_of(const Summary& summary) {
  std::vector<std::string> names;
  for (const EstimatorScore& estimator : summary.score.estimators) names.push_back(estimator.name);
  return names;
}

/// The types of the estimators, if the run's settings give them; otherwise their names.
std::vector<std::string> types_of(const std::vector<std::string>& names,
                                  const std::vector<worlds::EstimatorChoice>& choices) {
  std::vector<std::string> types = names;
  for (const worlds::EstimatorChoice& choice : choices) std::ranges::replace(types, choice.name, choice.type);
  return types;
}

/// Of world and estimators in words, what the folder tells.
std::vector<Description> descriptions_of(const std::filesystem::path& folder,
                                         const std::optional<worlds::World>& world,
                                         const std::vector<worlds::EstimatorChoice>& choices) {
  std::vector<Description> descriptions;
  if (world) {
    descriptions.push_back(describe(*world));
  } else if (std::filesystem::exists(folder / "log.yaml")) {
    LogDescription log;
    read_yaml(folder / "log.yaml", log);
    descriptions.push_back(describe(log));
  }
  if (!choices.empty()) descriptions.push_back(describe(choices));
  return descriptions;
}

std::vector<Fact> facts_of(const Summary& summary) {
  std::vector<Fact> facts = {{"World", summary.world},
                             {"Seed", fmt::format("{}", summary.seed)},
                             {"Simulated time", fmt::format("{:.1f} s", summary.duration)},
                             {"Updates", fmt::format("{}", summary.updates)},
                             {"Times real time", fmt::format("{:.1f}", summary.realtime_factor)},
                             {"Made by version", summary.version},
                             {"Trajectory hash", summary.trajectory_hash}};
  if (summary.interrupted)
    facts.push_back({"Interrupted", summary.error.empty() ? "before its end" : summary.error});
  return facts;
}

std::vector<Table> tables_of(const Summary& summary) {
  std::vector<Table> tables = {
      {"Scores", accuracy_table(summary),
       "NEES is the squared error over what the filter believes its variance to be, for each degree of "
       "freedom: 1 is right. Aligned errors are those after the rigid motion that makes them smallest."},
      {"Cost of an update", cost_table(summary)}};
  std::erase_if(tables, [](const Table& table) { return table.rows.size() < 2; });
  return tables;
}

std::vector<Table> tables_of(const RunDetails& details) {
  const std::vector<std::vector<TextRow>> rows = details_tables(details);
  std::vector<Table> tables = {
      {"The map", rows[0], "Inside: the share of NEES, of so many, that lie in the 95 % band."},
      {"As seen from the robot", rows[1],
       "NEES of the landmarks in the robot's frame, and NIS, the normalised innovation squared: 1 is right."},
      {"Relative pose error along the path", rows[2]}};
  if (details.closures > 0)
    tables.push_back({"Error of the position after a loop closure [m]", rows[3],
                      fmt::format("Root mean square over {} closures.", details.closures)});
  std::erase_if(tables, [](const Table& table) { return table.rows.size() < 2; });
  return tables;
}

MatrixFigure matrix_of(const LiveEstimator& estimator) {
  PointIndex map(1.0);
  for (const seif::LandmarkEstimate& landmark : estimator.filter->map())
    map.put(landmark.landmark, landmark.mean);
  MatrixPicture picture;
  picture.read(*estimator.filter, map);
  const bool is_covariance = picture.matrix() == seif::BeliefMatrix::covariance;
  MatrixFigure figure{.id = "matrix-" + file_name_of(estimator.name),
                      .title = estimator.name + (is_covariance ? ", covariance" : ", information")};
  figure.caption = fmt::format(
      "{:.1f} % of {} x {} blocks are not zero. {}", 100.0 * picture.fill(), map.size() + 1, map.size() + 1,
      is_covariance
          ? "A correlation of 0.9 is about a quarter dark, 0.99 half, 0.999 three quarters, 0.9999 black."
          : "How dark a block is grows with the fourth root of its strength.");
  figure.size = static_cast<std::size_t>(picture.size());
  for (const float strength : picture.cells())
    figure.cells.push_back(static_cast<std::uint8_t>(
        std::lround(255.0F * std::min(1.0F, MatrixPicture::darkness(picture.matrix(), strength)))));
  return figure;
}

/// Adds the results of a replay: scores to `details`, and the final matrices.
void add_replayed(const std::filesystem::path& folder, const Summary& summary, const seif::Registry& registry,
                  RunDetails& details, Page& page) {
  const TemporaryFolder replayed;
  std::vector<MatrixFigure> matrices;
  const auto look = [&](const Believers& believers) {
    for (const LiveEstimator& estimator : believers.estimators) {
      if (estimator.failure.empty() && estimator.filter->belief_matrix() != seif::BeliefMatrix::none)
        matrices.push_back(matrix_of(estimator));
    }
  };
  const auto go_without = [&](const std::exception& error) {
    page.matrices_note = fmt::format("Not known, since the run cannot be replayed: {}", error.what());
  };
  try {
    const std::vector<RebuiltScore> scores = rebuild(
        {.run = folder, .to = replayed.path(), .estimators = names_of(summary)}, summary, registry, look);
    for (std::size_t i = 0; i < scores.size(); ++i) details.estimators.at(i).rebuilt = scores[i];
    page.matrices = std::move(matrices);
    page.matrices_note =
        "What each filter keeps at the end: the robot first, then the landmarks in the order in which they "
        "joined "
        "the map. White is zero; the darker, the stronger.";
  } catch (const NotReplayed& error) {
    go_without(error);
  } catch (const BadInput& error) {
    go_without(error);
  }
}

/// The newest film in the folder.
std::optional<std::filesystem::path> find_film(const std::filesystem::path& folder) {
  std::optional<std::filesystem::path> newest;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (!entry.is_regular_file() || (extension != ".mp4" && extension != ".webm" && extension != ".gif"))
      continue;
    if (!newest || entry.last_write_time() > std::filesystem::last_write_time(*newest)) newest = entry.path();
  }
  return newest;
}

}  // namespace

Page run_page(const std::filesystem::path& folder, const seif::Registry& registry, bool replays) {
  Summary summary = read_summary(folder / "summary.json");
  const std::vector<std::string> names = names_of(summary);
  summary.score = score_folder(folder, names, summary.rpe_interval);
  RunDetails details = score_details(folder, names, {});
  Page page;
  page.title = fmt::format("{}, seed {}", summary.world, summary.seed);
  page.facts = facts_of(summary);
  page.notes = scoreboard_notes(summary) + without_truth(folder);
  const std::optional<worlds::World> world = world_of(folder, registry);
  const worlds::LoadResult settings = load_replay_settings(folder, {}, registry);
  const std::vector<worlds::EstimatorChoice> choices =
      settings.world ? settings.world->estimators : std::vector<worlds::EstimatorChoice>();
  page.descriptions = descriptions_of(folder, world, choices);
  page.figures = run_figures(folder, drawn(names, types_of(names, choices)), world ? &*world : nullptr);
  if (replays) add_replayed(folder, summary, registry, details, page);
  page.tables = tables_of(summary);
  page.details = tables_of(details);
  page.film = find_film(folder);
  if (std::filesystem::exists(folder / "world.yaml"))
    page.listings.push_back(
        {"The world, with all that it extends and that was set", read_whole_file(folder / "world.yaml")});
  return page;
}

Page page_of(const std::filesystem::path& folder, const seif::Registry& registry, bool replays) {
  if (std::filesystem::exists(folder / "sweep.json")) return sweep_page(folder);
  if (std::filesystem::exists(folder / "stress.json")) return stress_page(folder);
  if (std::filesystem::exists(folder / "paper.json")) return paper_page(folder, registry);
  if (std::filesystem::exists(folder / "comparison.json")) return comparison_page(folder);
  if (std::filesystem::exists(folder / "summary.json") || is_unfinished(folder))
    return run_page(folder, registry, replays);
  throw BadInput(fmt::format(
      "{}: is no folder of a run, a sweep, a stress test, a comparison or of seifbed paper: there "
      "is no summary.json, sweep.json, stress.json, comparison.json or paper.json",
      folder.string()));
}

}  // namespace harness
