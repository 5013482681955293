#include "harness/paper/paper_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "harness/files/text_table.hpp"
#include "harness/paper/published.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

constexpr double milli = 1e3;  // from m^2 to 1e-3 m^2

constexpr std::string_view definitions =
    "error     mean over the landmarks of the squared distance from estimate to truth when a run ends, mean\n"
    "          over the runs. The report does not say how it defines its own, nor which noise it simulates:\n"
    "          compare its ratios. Where a filter diverges in a run or two, its mean and interval are "
    "theirs:\n"
    "          read the median.\n"
    "over ekf  that mean over the EKF's in the same runs; the report's is the ratio of its two means.\n"
    "by run    ratio to the EKF's error in the same run, geometric mean over the runs. One run in which a "
    "filter\n"
    "          diverges does not decide it.\n"
    "aligned   ratio to the EKF's of the root mean square error after the rigid motion that brings a map\n"
    "          closest to the truth, in the same run; geometric mean over the runs.\n"
    "links     landmarks with a link to the robot + pairs of landmarks with a link, when a run ends. N = 50\n"
    "          landmarks have 50 + 50 * 49 / 2 = 1275 at the most.\n"
    "update    a scan with the motion before it: median in each run, mean over the runs, by the wall clock.\n"
    "grows     with the number N of landmarks; Cholesky: by a sparse factorisation in each update.\n"
    "NEES      e' P^-1 e / d of the error e in d dimensions, P the covariance that the filter believes, "
    "when\n"
    "          a run ends: of the pose, and mean over the landmarks; mean over the runs. 1 is right, more "
    "is\n"
    "          overconfident. The report does not have it.\n"
    "95 %      of means: BCa bootstrap, below 8 runs Student's for the logarithm of the mean; over ekf: "
    "Fieller's,\n"
    "          - where it is unbounded or reaches below zero; by run: Student's for the mean logarithm.\n";

const PublishedRow* published(const std::string& estimator) {
  const auto* row = std::ranges::find(published_rows, estimator, &PublishedRow::estimator);
  return row == published_rows.end() ? nullptr : row;
}

std::string title(const EstimatorComparison& estimator) {
  const PaperRow* row = paper_row(estimator.name);
  return row == nullptr ? estimator.name : fmt::format("{} ({})", row->title, estimator.name);
}

std::string value_cell(const std::optional<Estimate>& value, int decimals, double unit = 1.0) {
  return number_cell(value ? std::optional(unit * value->value) : std::nullopt, decimals);
}

std::string interval_cell(const std::optional<Estimate>& value, int decimals, double unit = 1.0) {
  if (!value || !value->interval) return "-";
  return fmt::format("{} to {}", number_cell(unit * value->interval->low, decimals),
                     number_cell(unit * value->interval->high, decimals));
}

TextRow error_row(const EstimatorComparison& estimator) {
  const PublishedRow* theirs = published(estimator.name);
  return {title(estimator),
          fmt::format("{}", estimator.runs),
          fmt::format("{}", estimator.failed),
          value_cell(estimator.landmark_mse, 2, milli),
          interval_cell(estimator.landmark_mse, 2, milli),
          number_cell(estimator.landmark_mse_median ? std::optional(milli * *estimator.landmark_mse_median)
                                                    : std::nullopt,
                      2),
          theirs == nullptr ? "-" : fmt::format("{:.2f} +- {:.2f}", theirs->error, theirs->error_half),
          value_cell(estimator.landmark_mse_ratio_of_means, 3),
          interval_cell(estimator.landmark_mse_ratio_of_means, 3),
          theirs == nullptr ? "-" : fmt::format("{:.3f}", theirs->error / published_rows.front().error),
          value_cell(estimator.landmark_mse_ratio, 3),
          interval_cell(estimator.landmark_mse_ratio, 3),
          value_cell(estimator.aligned_ratio, 3)};
}

std::string published_links(const PublishedRow* theirs) {
  if (theirs == nullptr) return "-";
  if (!theirs->links_half) return fmt::format("{:.0f}", theirs->links);
  return fmt::format("{:.0f} +- {:.2f}", theirs->links, *theirs->links_half);
}

TextRow cost_row(const EstimatorComparison& estimator) {
  const PublishedRow* theirs = published(estimator.name);
  const PaperRow* ours = paper_row(estimator.name);
  return {title(estimator),
          value_cell(estimator.links, 1),
          interval_cell(estimator.links, 1),
          published_links(theirs),
          number_cell(estimator.update_p50_us, 1),
          ours == nullptr ? "-" : std::string(ours->update),
          theirs == nullptr ? "-" : std::string(theirs->update)};
}

TextRow nees_row(const EstimatorComparison& estimator) {
  return {title(estimator), value_cell(estimator.nees_pose, 2), interval_cell(estimator.nees_pose, 2),
          value_cell(estimator.nees_landmark, 2), interval_cell(estimator.nees_landmark, 2)};
}

/// The value of an option of an estimator; "-" if it has no such option.
std::string setting(const worlds::World& world, const std::string& estimator, const std::string& option) {
  const auto choice = std::ranges::find(world.estimators, estimator, &worlds::EstimatorChoice::name);
  if (choice == world.estimators.end()) return "-";
  const auto value = choice->options.find(option);
  if (value == choice->options.end() || !std::holds_alternative<std::int64_t>(value->second)) return "-";
  return fmt::format("{}", std::get<std::int64_t>(value->second));
}

std::string heading(const PaperPlan& plan, const worlds::World& world, const Comparison& comparison) {
  const std::int64_t updates = comparison.runs.empty() ? 0 : comparison.runs.front().result.summary.updates;
  return fmt::format("{}: {} landmarks, {} updates, theta_x = {}, K = {}, {}, {} runs from seed {}{}\n",
                     comparison.name, world.landmarks.size(), updates,
                     setting(world, "seif_report", "theta_x"), setting(world, "seif_report", "K"),
                     world.physics.engine == worlds::Engine::kinematic ? "kinematic" : "in Bullet",
                     comparison.runs.size(), plan.first_seed, comparison.interrupted ? " (interrupted)" : "");
}

Json json_of(const std::optional<Estimate>& value) {
  const bool is_bounded = value && value->interval;
  return {{"value", value ? Json(value->value) : Json(nullptr)},
          {"low", is_bounded ? Json(value->interval->low) : Json(nullptr)},
          {"high", is_bounded ? Json(value->interval->high) : Json(nullptr)}};
}

Json json_of(const PublishedRow* row) {
  if (row == nullptr) return nullptr;
  return {{"runs", row->runs},
          {"error", row->error / milli},
          {"error_half_interval", row->error_half / milli},
          {"error_over_ekf", row->error / published_rows.front().error},
          {"links", row->links},
          {"links_half_interval", row->links_half ? Json(*row->links_half) : Json(nullptr)},
          {"update", row->update}};
}

Json json_of(const EstimatorComparison& estimator) {
  return {{"runs", estimator.runs},
          {"failed", estimator.failed},
          {"landmark_mse_m2", json_of(estimator.landmark_mse)},
          {"landmark_mse_median_m2",
           estimator.landmark_mse_median ? Json(*estimator.landmark_mse_median) : Json(nullptr)},
          {"landmark_mse_ratio", json_of(estimator.landmark_mse_ratio)},
          {"landmark_mse_ratio_of_means", json_of(estimator.landmark_mse_ratio_of_means)},
          {"landmark_rmse_aligned_ratio", json_of(estimator.aligned_ratio)},
          {"links", json_of(estimator.links)},
          {"nees_pose_final", json_of(estimator.nees_pose)},
          {"nees_landmark_final", json_of(estimator.nees_landmark)},
          {"report", json_of(published(estimator.name))}};
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::vector<std::vector<TextRow>> paper_tables(const Comparison& comparison) {
  std::vector<TextRow> errors = {{"final error", "runs", "failed", "[1e-3 m^2]", "95 %", "median", "report",
                                  "over ekf", "95 %", "report", "by run", "95 %", "aligned"}};
  std::vector<TextRow> costs = {
      {"links and time", "links", "95 %", "report", "update [us]", "grows", "report"}};
  std::vector<TextRow> nees = {{"consistency", "NEES pose", "95 %", "NEES map", "95 %"}};
  for (const EstimatorComparison& estimator : comparison.estimators) {
    errors.push_back(error_row(estimator));
    costs.push_back(cost_row(estimator));
    nees.push_back(nees_row(estimator));
  }
  return {errors, costs, nees};
}

std::string paper_board(const PaperPlan& plan, const worlds::World& world, const Comparison& comparison) {
  const std::vector<std::vector<TextRow>> tables = paper_tables(comparison);
  const std::string failed = failures_of(comparison);
  return fmt::format("{}\n{}\n{}\n{}\n{}{}{}", heading(plan, world, comparison), text_table(tables[0]),
                     text_table(tables[1]), text_table(tables[2]), definitions, failed.empty() ? "" : "\n",
                     failed);
}

std::string paper_json(const PaperPlan& plan, const worlds::World& world, const Comparison& comparison) {
  Json json = {{"name", comparison.name},
               {"version", program_version()},
               {"engine", world.physics.engine == worlds::Engine::kinematic ? "kinematic" : "bullet"},
               {"landmarks", world.landmarks.size()},
               {"first_seed", plan.first_seed},
               {"runs", comparison.runs.size()},
               {"interrupted", comparison.interrupted},
               {"set", paper_overrides(plan)},
               {"baseline", comparison.baseline},
               {"estimators", Json::object()}};
  for (const EstimatorComparison& estimator : comparison.estimators)
    json["estimators"][estimator.name] = json_of(estimator);
  return text_of(json);
}

std::string paper_times_json(const PaperPlan& plan, const Comparison& comparison) {
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  Json json = {{"jobs", plan.jobs}, {"estimators", Json::object()}};
  for (const EstimatorComparison& estimator : comparison.estimators) {
    json["estimators"][estimator.name] = {{"update_p50_us", number(estimator.update_p50_us)},
                                          {"update_p99_us", number(estimator.update_p99_us)}};
  }
  return text_of(json);
}

std::string paper_runs_csv(const Comparison& comparison) {
  const auto cell = [](const auto& value) { return value ? fmt::format("{}", *value) : std::string(); };
  std::string text = "run,estimator,landmark_rmse_m,landmark_rmse_aligned_m,links,nees_pose,nees_landmark\n";
  for (const ComparedRun& run : comparison.runs) {
    for (const EstimatorScore& score : run.result.summary.score.estimators) {
      text += fmt::format("{},{},{},{},{},{},{}\n", run.name, score.name, cell(score.landmarks.rmse),
                          cell(score.landmarks.rmse_aligned), cell(score.links), cell(score.nees_pose_final),
                          cell(score.nees_landmark_final));
    }
  }
  return text;
}

}  // namespace harness
