#include "harness/paper/paper.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/comparison/parallel_runs.hpp"
#include "harness/estimators/estimator_schemas.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/paper/report_world.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

std::string all_estimators() {
  std::string text;
  for (const PaperRow& row : paper_rows)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", row.estimator, row.settings);
  return text;
}

}  // namespace

const PaperRow* paper_row(std::string_view estimator) {
  const auto* row = std::ranges::find(paper_rows, estimator, &PaperRow::estimator);
  return row == paper_rows.end() ? nullptr : row;
}

std::vector<std::string> paper_overrides(const PaperPlan& plan) {
  std::vector<std::string> overrides = {
      fmt::format("physics.engine={}", plan.physics ? "bullet" : "kinematic"),
      // With the 5 m of the world file some landmarks are never seen; the report's EKF has all 50.
      "sensors.landmark_sensor.max_range_m=6",
      "scoring.interval_s=1000",  // at the end only
      fmt::format("estimators={{{}}}", all_estimators()),
  };
  overrides.insert(overrides.end(), plan.overrides.begin(), plan.overrides.end());
  return overrides;
}

worlds::LoadResult load_paper_world(const PaperPlan& plan, const seif::Registry& registry) {
  const TemporaryFolder folder;
  write_whole_file(folder / "report2002.yaml", report_world());
  std::vector<std::string> overrides = paper_overrides(plan);
  overrides.push_back(fmt::format("seed={}", plan.first_seed));
  return worlds::load_world(folder / "report2002.yaml", overrides, estimator_schemas(registry),
                            program_version());
}

worlds::World paper_world(const PaperPlan& plan, std::uint64_t seed, const seif::Registry& registry) {
  const worlds::LoadResult loaded = worlds::load_world(
      plan.folder / "world.yaml", {fmt::format("seed={}", seed)}, estimator_schemas(registry));
  if (!loaded.world) throw BadInput(worlds::to_string(loaded.problems.front()));
  return *loaded.world;
}

Comparison run_paper(const PaperPlan& plan, const std::string& name, const seif::Registry& registry) {
  std::vector<PlannedRun> planned;
  for (std::int64_t i = 0; i < plan.runs; ++i) {
    const std::uint64_t seed = plan.first_seed + static_cast<std::uint64_t>(i);
    planned.push_back({fmt::format("{}-{}", name, seed), [&plan, &registry, seed] {
                         PreparedRun run = prepare_run(paper_world(plan, seed, registry), registry);
                         return DetailedRun{execute_in_passing(run)};
                       }});
  }
  FinishedRuns finished = execute_all(planned, plan.jobs, plan.quiet);
  Comparison comparison;
  comparison.name = name;
  comparison.baseline = "ekf";
  comparison.interrupted = finished.interrupted;
  comparison.runs = std::move(finished.runs);
  compare_estimators(comparison);
  return comparison;
}

}  // namespace harness
