#include "harness/score/scoreboard.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "harness/files/text_table.hpp"
#include "harness/statistics/degrees.hpp"
#include "harness/statistics/divergence.hpp"

namespace harness {

namespace {

std::string number(std::optional<double> value, int decimals, double scale = 1.0) {
  if (value) *value *= scale;
  return number_cell(value, decimals);
}

template <class Integer>
std::string count_text(const std::optional<Integer>& value) {
  return value ? fmt::format("{}", *value) : "-";
}

std::string memory(const std::optional<std::int64_t>& bytes) {
  return bytes ? fmt::format("{:.1f}", static_cast<double>(*bytes) / 1024.0) : "-";
}

std::optional<double> part(const std::optional<Percentiles>& values, double Percentiles::*which) {
  return values ? std::optional((*values).*which) : std::nullopt;
}

TextRow accuracy_row(const EstimatorScore& score) {
  return {score.name,
          count_text(score.landmarks_mapped) + (score.by_place ? " *" : ""),
          number(score.landmarks.rmse, 3),
          number(score.landmarks.rmse_aligned, 3),
          number(score.trajectory.rmse, 3),
          number(score.rpe.translation, 4),
          number(score.rpe.rotation, 3, degrees_per_radian),
          number(score.nees_pose, 2),
          number(score.nees_landmark, 2)};
}

TextRow cost_row(const EstimatorScore& score) {
  return {score.name,
          number(part(score.update_us, &Percentiles::p50), 1),
          number(part(score.update_us, &Percentiles::p95), 1),
          number(part(score.update_us, &Percentiles::p99), 1),
          number(part(score.update_us, &Percentiles::max), 1),
          number(part(score.blocks_touched, &Percentiles::p50), 0),
          number(part(score.blocks_touched, &Percentiles::max), 0),
          count_text(score.links),
          count_text(score.active_max),
          memory(score.memory_bytes)};
}

/// What the reader of the log left out or bridged; empty if nothing.
std::string log_line(const Summary& summary) {
  if (summary.log_counts.empty()) return "";
  std::string text;
  for (const auto& [name, value] : summary.log_counts)
    text += fmt::format("{}{} {}", text.empty() ? "\nLeft out of the log, or bridged: " : ", ", name, value);
  return text + '\n';
}

std::string note_lines(const Summary& summary) {
  return summary.notes.empty() ? "" : fmt::format("\n{}\n", fmt::join(summary.notes, "\n"));
}

/// What was not given to the estimators, one line for each kind; empty if nothing.
std::string left_out_line(const Summary& summary) {
  if (summary.left_out.empty()) return "";
  std::string text =
      fmt::format("\nNot given to the estimators, from {} s on:\n", summary.left_out_t.value_or(0.0));
  for (const auto& [name, value] : summary.left_out) text += fmt::format("  {} {}\n", name, value);
  return text;
}

/// What the log does not say of the true poses, and what has no score for that reason; empty if it says all.
std::string truth_lines(const Summary& summary) {
  const RunScore& score = summary.score;
  std::string text;
  if (score.poses_are_known && score.times_without_truth > 0)
    text +=
        fmt::format("The true pose is not known at {} scoring times, the first at {} s: they have no NEES\n",
                    score.times_without_truth, score.without_truth_t.value_or(0.0));
  if (!score.frame_is_known && (score.poses_are_known || score.landmarks_are_known))
    text += "The true pose at the start is not known: there are no errors without alignment, and no NEES\n";
  return text.empty() ? text : '\n' + text;
}

/// The estimators that diverged, and those whose covariance was not positive definite; empty if there are
/// none.
std::string divergence_lines(const Summary& summary) {
  std::string text;
  for (const EstimatorScore& score : summary.score.estimators) {
    if (score.diverged_t)
      text += fmt::format("{} diverged at {} s: its innovations are too large (NIS up to {:.3g})\n",
                          score.name, *score.diverged_t, score.worst_nis.value_or(0.0));
    if (score.diverged_nees_t)
      text += fmt::format("{} diverged by {} s: the NEES of its pose is above {:.1f}\n", score.name,
                          *score.diverged_nees_t, highest_nees_pose());
    if (score.improper_beliefs > 0)
      text += fmt::format("{} had no positive definite belief at {} scoring times, the first at {} s\n",
                          score.name, score.improper_beliefs, score.improper_t.value_or(0.0));
  }
  return text.empty() ? text : '\n' + text;
}

std::string times(int count) { return count == 1 ? "once" : fmt::format("{} times", count); }

/// The estimators that lost their place, and how often they found it again; empty if there are none.
std::string loss_lines(const Summary& summary) {
  std::string text;
  for (const EstimatorScore& score : summary.score.estimators) {
    const Losses& losses = score.losses;
    if (losses.count() == 0) continue;
    text += fmt::format("{} lost its place {}, for {:.1f} s in all, and found it {}", score.name,
                        times(losses.count()), losses.lost_s(), times(losses.found()));
    if (losses.first_found_t()) text += fmt::format(", first at {} s", *losses.first_found_t());
    if (losses.found_wrongly() > 0) text += fmt::format(", wrongly {}", times(losses.found_wrongly()));
    text += '\n';
  }
  return text.empty() ? text : '\n' + text;
}

/// One line with a counter of all estimators, without those where it is zero; empty if it is zero for all.
std::string count_line(const Summary& summary, std::string_view what,
                       std::optional<std::int64_t> EstimatorScore::*count) {
  std::string text;
  for (const EstimatorScore& score : summary.score.estimators) {
    if ((score.*count).value_or(0) > 0)
      text += fmt::format("{} {} {}", text.empty() ? fmt::format("\n{}:", what) : ",", score.name,
                          *(score.*count));
  }
  return text.empty() ? text : text + '\n';
}

std::string gate_line(const Summary& summary) {
  return count_line(summary, "Observations left out by the gate", &EstimatorScore::gated) +
         count_line(summary, "Observations that counted less", &EstimatorScore::weakened);
}

/// How the landmarks of an estimator with names of its own were found in the world, where that is not
/// recorded; empty without such an estimator.
std::string matching_lines(const Summary& summary) {
  std::string text;
  for (const EstimatorScore& score : summary.score.estimators) {
    if (score.by_place) {
      const MapCounts& map = *score.by_place;
      const std::string missed = map.missed ? fmt::format("{} missed, ", *map.missed) : "";
      text += fmt::format(
          "\n* Landmarks of {} matched by place: {} matched, {}{} spurious, {} of them duplicate", score.name,
          score.landmarks_mapped.value_or(0) - map.spurious, missed, map.spurious, map.duplicate);
    } else if (score.matched_by == MatchedBy::nothing && summary.score.landmarks_are_known) {
      text += fmt::format(
          "\nThe map of {} has no score: its names are its own, and its place among the true landmarks is "
          "not clear",
          score.name);
    }
  }
  return text.empty() ? text : text + '\n';
}

/// The associations of the estimators that name landmarks by themselves; empty without such an estimator.
std::string association_lines(const Summary& summary) {
  std::string text;
  for (const EstimatorScore& score : summary.score.estimators) {
    if (!score.associations_left_out) continue;
    text += fmt::format("\nAssociations of {}: {} % right, {} % of the observations left out", score.name,
                        number(score.associations_right, 2, 100.0),
                        number(score.associations_left_out, 2, 100.0));
  }
  return text.empty() ? text : text + '\n';
}

}  // namespace

std::vector<TextRow> accuracy_table(const Summary& summary) {
  std::vector<TextRow> accuracy = {{"estimator", "landmarks", "map RMSE [m]", "aligned [m]", "ATE [m]",
                                    "RPE [m]", "RPE [deg]", "NEES pose", "NEES map"}};
  for (const EstimatorScore& score : summary.score.estimators) accuracy.push_back(accuracy_row(score));
  accuracy.push_back(accuracy_row(summary.score.odometry));
  return accuracy;
}

std::vector<TextRow> cost_table(const Summary& summary) {
  std::vector<TextRow> cost = {{"update", "p50 [us]", "p95 [us]", "p99 [us]", "max [us]", "blocks p50",
                                "blocks max", "links", "active", "memory [KiB]"}};
  for (const EstimatorScore& score : summary.score.estimators) cost.push_back(cost_row(score));
  return cost;
}

std::string scoreboard(const Summary& summary) {
  const std::vector<TextRow> cost = cost_table(summary);
  std::string text = fmt::format("{}, seed {}: {:.1f} s, {} updates, {:.1f} times real time{}\n\n",
                                 summary.world, summary.seed, summary.duration, summary.updates,
                                 summary.realtime_factor, summary.interrupted ? " (interrupted)" : "");
  text += text_table(accuracy_table(summary));
  if (cost.size() > 1) text += '\n' + text_table(cost);
  return text + scoreboard_notes(summary);
}

std::string scoreboard_notes(const Summary& summary) {
  std::string text = note_lines(summary) + log_line(summary) + left_out_line(summary) + truth_lines(summary) +
                     matching_lines(summary) + gate_line(summary) + association_lines(summary) +
                     loss_lines(summary) + divergence_lines(summary);
  for (std::size_t i = 0; i < summary.failures.size(); ++i) {
    if (!summary.failures[i].empty())
      text += fmt::format("\n{} failed {}\n", summary.score.estimators[i].name, summary.failures[i]);
  }
  return text;
}

std::string without_truth(const std::filesystem::path& run) {
  const bool poses = std::filesystem::exists(run / "truth.csv");
  const bool landmarks = std::filesystem::exists(run / "landmarks.csv");
  if (poses && landmarks) return "";
  return fmt::format(
      "\nThe log holds no truth of the {}: what would be compared with it is not scored.\n"
      "--reference batch compares with the optimum of what was measured, which is no truth.\n",
      poses ? "landmarks" : (landmarks ? "poses" : "poses, nor of the landmarks"));
}

}  // namespace harness
