#include "harness/stress/scaling.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace harness {

namespace {

void add(std::vector<StageScaling>& stages, const std::string& name, std::int64_t landmarks,
         const std::optional<Percentiles>& us) {
  if (!us || us->p50 <= 0.0) return;
  auto stage = std::ranges::find(stages, name, &StageScaling::name);
  if (stage == stages.end()) {
    stages.push_back({.name = name, .landmarks = {}, .us = {}, .slope = {}});
    stage = stages.end() - 1;
  }
  stage->landmarks.push_back(static_cast<double>(landmarks));
  stage->us.push_back(us->p50);
}

std::vector<double> logarithms(std::vector<double> values) {
  for (double& value : values) value = std::log(value);
  return values;
}

}  // namespace

std::vector<StageScaling> scaling_of(const std::vector<StressRow>& rows) {
  std::vector<StageScaling> stages;
  for (const StressRow& row : rows) {
    add(stages, "physics step", row.landmarks, row.step_us);
    add(stages, "scan", row.landmarks, row.scan_us);
    add(stages, "rest", row.landmarks, row.rest_us);
    add(stages, "simulated second", row.landmarks, row.second_us);
    for (const StressEstimator& estimator : row.estimators)
      add(stages, estimator.name, row.landmarks, estimator.update_us);
  }
  for (StageScaling& stage : stages)
    stage.slope = slope_of(logarithms(stage.landmarks), logarithms(stage.us));
  return stages;
}

}  // namespace harness
