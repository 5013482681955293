#include "harness/exports/trajectories.hpp"

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <vector>

#include "harness/files/csv_writer.hpp"
#include "harness/score/score_folder.hpp"
#include "harness/stream/log_stream.hpp"

namespace harness {

namespace {

void add_columns(const std::string& name, std::string& header) {
  for (const char* part : {"x", "y", "theta"}) header += ',' + csv_cell(fmt::format("{}_{}", name, part));
}

void add_pose(const std::optional<seif::Pose2>& pose, std::string& text) {
  if (pose) {
    fmt::format_to(std::back_inserter(text), ",{},{},{}", pose->x, pose->y, pose->theta);
  } else {
    text += ",,,";
  }
}

}  // namespace

std::string trajectories_csv(const std::filesystem::path& run, std::span<const std::string> estimators) {
  std::vector<std::string> names = {"odometry"};
  names.insert(names.end(), estimators.begin(), estimators.end());
  std::string text = "t";
  std::optional<TruthReader> truth;
  if (std::filesystem::exists(run / "truth.csv")) truth.emplace(run);
  if (truth) add_columns("true", text);
  std::vector<std::vector<TimedPose>> trajectories;
  for (const std::string& name : names) {
    add_columns(name, text);
    trajectories.push_back(read_trajectory(run, name));
  }
  text += '\n';
  for (std::size_t i = 0; i < trajectories.front().size(); ++i) {
    const double t = trajectories.front()[i].t;
    fmt::format_to(std::back_inserter(text), "{}", t);
    if (truth) {
      const std::optional<TruePose> pose = truth->at(t);
      add_pose(pose ? std::optional(pose->T_world_robot) : std::nullopt, text);
    }
    for (const std::vector<TimedPose>& poses : trajectories)
      add_pose(i < poses.size() ? std::optional(poses[i].T_world_robot) : std::nullopt, text);
    text += '\n';
  }
  return text;
}

}  // namespace harness
