// The optimum of a recorded run as a row of its score table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/score/details.hpp"
#include "harness/score_folder.hpp"
#include "harness/summary.hpp"
#include "seif/registry.hpp"

namespace harness {

struct ReferenceScore {
  EstimatorScore score;  // under the name of the reference; without costs, which are those of no filter
  EstimatorDetails details;
  ReferenceEstimate estimate;
};

/// What `--reference` may be: `batch`, or `robust_batch`, in which observations that are more than 3 sigma
/// off weigh less.
std::vector<std::string> reference_names();

/// Replays a run for `name`, solves once at the end, and scores map, belief and trajectory of the optimum.
/// Throws BadInput if the run has an estimator of that name, and std::runtime_error if no optimum is found.
ReferenceScore score_reference(const std::string& name, const std::filesystem::path& run,
                               const Summary& summary, const DetailChoices& choices,
                               const seif::Registry& registry);

}  // namespace harness
