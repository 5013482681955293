#include "harness/run/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "harness/estimators/batch.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/csv_writer.hpp"
#include "harness/readers/open_log.hpp"
#include "harness/recording/recorder.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/rebuilding.hpp"

namespace harness {

namespace {

constexpr double never = 1e300;  // [s] scores at the end only

/// Replaces the recorded poses of the guide by those of the optimum.
void write_trajectory(const std::filesystem::path& folder, const std::string& name,
                      const seif::Estimator& filter) {
  const std::vector<seif::Pose2> poses = dynamic_cast<const Batch&>(filter).trajectory();
  const std::vector<TimedPose> times = read_trajectory(folder, name);
  std::filesystem::remove(folder / (name + ".tum"));
  CsvWriter file(folder / (name + ".tum"), no_header, ' ');
  for (std::size_t i = 0; i < poses.size(); ++i) write_pose(file, times.at(i).t, poses[i]);
  file.close();
}

std::string settings_of(const std::string& name) {
  return fmt::format("estimators.{}={{type: batch, robust_above: {}}}", name, name == "robust_batch" ? 3 : 0);
}

void leave_out_costs(EstimatorScore& score) {
  score.update_us.reset();
  score.stage_us = {};
  score.blocks_touched.reset();
  score.mean_residual.reset();
  for (auto* count : {&score.links, &score.links_max, &score.relocations, &score.gated, &score.weakened,
                      &score.active_max, &score.memory_bytes})
    count->reset();
  score.anchoring.reset();
}

}  // namespace

bool is_optimum(std::string_view reference) { return reference != "mrpt_ekf"; }

ReferenceScore score_reference(const std::string& name, const std::filesystem::path& run,
                               const Summary& summary, const DetailChoices& choices,
                               const seif::Registry& registry) {
  if (std::ranges::find(summary.score.estimators, name, &EstimatorScore::name) !=
      summary.score.estimators.end())
    throw BadInput(fmt::format("--reference {}: the run has an estimator of this name", name));
  if (!open_log(LogChoice{.path = run})->description().known_association)
    throw std::runtime_error("the observations do not name their landmarks");
  const TemporaryFolder folder;
  Rebuilding rebuilding{.run = run, .to = folder.path(), .estimators = {name}, .is_other = true};
  if (is_optimum(name)) {
    rebuilding.interval = never;
    rebuilding.overrides = {settings_of(name)};
  }
  const auto look = [&](const Believers& believers) {
    const LiveEstimator& estimator = believers.estimators.front();
    if (!estimator.failure.empty())
      throw std::runtime_error(fmt::format("{} failed {}", name, estimator.failure));
    if (is_optimum(name)) write_trajectory(folder.path(), name, *estimator.filter);
  };
  const std::vector<RebuiltScore> rebuilt = rebuild(rebuilding, summary, registry, look);
  DetailChoices of_the_replay = choices;
  of_the_replay.consistency.clear();
  ReferenceScore reference;
  reference.score = score_folder(folder.path(), {{name}}, summary.rpe_interval).estimators.front();
  reference.details = score_details(folder.path(), {{name}}, of_the_replay).estimators.front();
  reference.details.rebuilt = rebuilt.front();
  if (is_optimum(name)) leave_out_costs(reference.score);
  for (const MapRecord& landmark : read_map(folder.path(), name))
    reference.estimate.map.push_back({landmark.landmark, landmark.mean, 0.0});
  std::ranges::sort(reference.estimate.map, {}, &TrueLandmark::landmark);
  reference.estimate.trajectory = read_trajectory(folder.path(), name);
  return reference;
}

}  // namespace harness
