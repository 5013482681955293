#include "harness/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "harness/batch.hpp"
#include "harness/csv_reader.hpp"
#include "harness/csv_writer.hpp"
#include "harness/rebuilding.hpp"
#include "harness/recorder.hpp"
#include "harness/run_folder.hpp"

namespace harness {

namespace {

const std::string optimum_name = "batch";

constexpr double never = 1e300;  // [s] but at the end

/// The optimum's poses in the place of those that its guide had on the way.
void write_trajectory(const std::filesystem::path& folder, const Believers& believers) {
  const std::vector<seif::Pose2> poses =
      dynamic_cast<const Batch&>(*believers.estimators.front().filter).trajectory();
  const std::vector<TimedPose> times = read_trajectory(folder, optimum_name);
  const std::filesystem::path path = folder / (optimum_name + ".tum");
  std::filesystem::remove(path);
  CsvWriter file(path, no_header, ' ');
  for (std::size_t i = 0; i < poses.size(); ++i) write_pose(file, times.at(i).t, poses[i]);
  file.close();
}

void leave_out_costs(EstimatorScore& score) {
  score.update_us.reset();
  score.stage_us = {};
  score.blocks_touched.reset();
  score.mean_residual.reset();
  for (auto* count :
       {&score.links, &score.links_max, &score.relocations, &score.active_max, &score.memory_bytes})
    count->reset();
  score.anchoring.reset();
}

}  // namespace

ReferenceScore score_reference(const std::string& name, const std::filesystem::path& run,
                               const Summary& summary, const DetailChoices& choices,
                               const seif::Registry& registry) {
  if (std::ranges::find(summary.score.estimators, name, &EstimatorScore::name) !=
      summary.score.estimators.end())
    throw BadInput(fmt::format("--reference {}: the run has an estimator of this name", name));
  const bool is_optimum = name == optimum_name;
  const TemporaryFolder folder;
  Rebuilding rebuilding{.run = run, .to = folder.path(), .estimators = {name}, .is_other = true};
  if (is_optimum) rebuilding.interval = never;
  const auto look = [&](const Believers& believers) {
    const LiveEstimator& estimator = believers.estimators.front();
    if (!estimator.failure.empty())
      throw std::runtime_error(fmt::format("{} failed {}", name, estimator.failure));
    if (is_optimum) write_trajectory(folder.path(), believers);
  };
  const std::vector<RebuiltScore> rebuilt = rebuild(rebuilding, summary, registry, look);
  DetailChoices of_the_replay = choices;
  of_the_replay.consistency.clear();
  ReferenceScore reference;
  reference.score = score_folder(folder.path(), {{name}}, summary.rpe_interval).estimators.front();
  reference.details = score_details(folder.path(), {{name}}, of_the_replay).estimators.front();
  reference.details.rebuilt = rebuilt.front();
  if (is_optimum) leave_out_costs(reference.score);
  return reference;
}

}  // namespace harness
