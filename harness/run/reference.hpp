// References for a recorded run, as rows of its score table.
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

/// `batch`, the optimum; `robust_batch`, in which observations more than 3 sigma off get less weight; and
/// `mrpt_ekf`, a peer.
inline constexpr std::array<std::string_view, 3> references = {"batch", "robust_batch", "mrpt_ekf"};
bool is_optimum(std::string_view reference);

/// Replays a run for a reference and scores it. An optimum is computed once, at the end, with a map, a belief
/// and a trajectory of its own, and without costs. Throws BadInput if the run has an estimator of that name or
/// the reference cannot be made, and std::runtime_error if no optimum is found.
ReferenceScore score_reference(const std::string& name, const std::filesystem::path& run,
                               const Summary& summary, const DetailChoices& choices,
                               const seif::Registry& registry);

}  // namespace harness
