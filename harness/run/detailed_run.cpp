#include "harness/run/detailed_run.hpp"

#include <vector>

#include "harness/files/output_file.hpp"
#include "harness/run/rebuilding.hpp"

namespace harness {

DetailedRun execute_in_detail(PreparedRun& run) {
  RebuiltConsistency rebuilt(*run.believers, *run.log, run.plan.scoring.landmark_sample);
  DetailedRun done{.result = execute(run, &rebuilt)};
  if (!done.result.error.empty()) return done;
  std::vector<std::string> names;
  for (const LiveEstimator& estimator : run.believers->estimators) names.push_back(estimator.name);
  done.details = score_details(run.plan.folder, names, {});
  const std::vector<RebuiltScore> scores = rebuilt.scores();
  for (std::size_t i = 0; i < scores.size(); ++i) done.details->estimators.at(i).rebuilt = scores[i];
  write_whole_file(run.plan.folder / "summary.json", to_json(done));
  return done;
}

std::string to_json(const DetailedRun& run) {
  return run.details ? to_json(run.result.summary, *run.details) : to_json(run.result.summary);
}

}  // namespace harness
