// Others that a recorded run is measured against, as rows of its score table.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/score/details.hpp"
#include "harness/score/score_folder.hpp"
#include "harness/score/summary.hpp"
#include "seif/registry.hpp"

namespace harness {

struct ReferenceScore {
  EstimatorScore score;  // under the name of the reference
  EstimatorDetails details;
  ReferenceEstimate estimate;
};

/// `batch`, the optimum; `robust_batch`, in which observations that are more than 3 sigma off weigh less; and
/// `mrpt_ekf`, a peer.
inline constexpr std::array<std::string_view, 3> references = {"batch", "robust_batch", "mrpt_ekf"};
bool is_optimum(std::string_view reference);

/// Replays a run for a reference and scores it. An optimum is solved for once at the end; map, belief and
/// trajectory are its own, and costs it has none. Throws BadInput if the run has an estimator of that name or
/// the reference cannot be made, and std::runtime_error if no optimum is found.
ReferenceScore score_reference(const std::string& name, const std::filesystem::path& run,
                               const Summary& summary, const DetailChoices& choices,
                               const seif::Registry& registry);

}  // namespace harness
