#include "harness/scoreboard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numbers>

namespace harness {

namespace {

using Row = std::vector<std::string>;

constexpr double degrees = 180.0 / std::numbers::pi;

std::string number(const std::optional<double>& value, int decimals, double scale = 1.0) {
  if (!value) return "-";
  const double scaled = *value * scale;
  // What does not fit into a column is told by its magnitude.
  return scaled < 1e6 ? fmt::format("{:.{}f}", scaled, decimals) : fmt::format("{:.1e}", scaled);
}

template <class Integer>
std::string count(const std::optional<Integer>& value) {
  return value ? fmt::format("{}", *value) : "-";
}

std::string memory(const std::optional<std::int64_t>& bytes) {
  return bytes ? fmt::format("{:.1f}", static_cast<double>(*bytes) / 1024.0) : "-";
}

std::optional<double> part(const std::optional<Percentiles>& values, double Percentiles::*which) {
  return values ? std::optional((*values).*which) : std::nullopt;
}

/// Columns as wide as they need, the first to the left and the others to the right.
std::string table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    text += fmt::format("{:<{}}", row.front(), widths.front());
    for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("  {:>{}}", row[i], widths[i]);
    text += '\n';
  }
  return text;
}

Row accuracy_row(const EstimatorScore& score) {
  return {score.name,
          count(score.landmarks_mapped),
          number(score.landmarks.rmse, 3),
          number(score.landmarks.rmse_aligned, 3),
          number(score.trajectory.rmse, 3),
          number(score.rpe.translation, 4),
          number(score.rpe.rotation, 3, degrees),
          number(score.nees_pose, 2),
          number(score.nees_landmark, 2)};
}

Row cost_row(const EstimatorScore& score) {
  return {score.name,
          number(part(score.update_us, &Percentiles::p50), 1),
          number(part(score.update_us, &Percentiles::p95), 1),
          number(part(score.update_us, &Percentiles::p99), 1),
          number(part(score.update_us, &Percentiles::max), 1),
          number(part(score.blocks_touched, &Percentiles::p50), 0),
          number(part(score.blocks_touched, &Percentiles::max), 0),
          count(score.links),
          count(score.active_max),
          memory(score.memory_bytes)};
}

}  // namespace

std::string scoreboard(const Summary& summary) {
  std::vector<Row> accuracy = {{"estimator", "landmarks", "map RMSE [m]", "aligned [m]", "ATE [m]", "RPE [m]",
                                "RPE [deg]", "NEES pose", "NEES map"}};
  std::vector<Row> cost = {{"update", "p50 [us]", "p95 [us]", "p99 [us]", "max [us]", "blocks p50",
                            "blocks max", "links", "active", "memory [KiB]"}};
  for (const EstimatorScore& score : summary.score.estimators) {
    accuracy.push_back(accuracy_row(score));
    cost.push_back(cost_row(score));
  }
  accuracy.push_back(accuracy_row(summary.score.odometry));
  std::string text = fmt::format("{}, seed {}: {:.1f} s, {} updates, {:.1f} times real time{}\n\n",
                                 summary.world, summary.seed, summary.duration, summary.updates,
                                 summary.realtime_factor, summary.interrupted ? " (interrupted)" : "");
  text += table(accuracy);
  if (cost.size() > 1) text += '\n' + table(cost);
  for (std::size_t i = 0; i < summary.failures.size(); ++i) {
    if (!summary.failures[i].empty())
      text += fmt::format("\n{} failed {}\n", summary.score.estimators[i].name, summary.failures[i]);
  }
  return text;
}

}  // namespace harness
