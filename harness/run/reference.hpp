// References for a recorded run. A reference is an additional row of the score table.
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
  EstimatorScore score;  // its name is that of the reference
  EstimatorDetails details;
  ReferenceEstimate estimate;
};

/// `batch` is the least-squares optimum. `robust_batch` is the same, but observations with residuals above 3
/// sigma count less. `mrpt_ekf` is the filter of another project.
inline constexpr std::array<std::string_view, 3> references = {"batch", "robust_batch", "mrpt_ekf"};
bool is_optimum(std::string_view reference);

/// Replays a run for a reference and scores it. An optimum is solved for once, at the end; map, belief and
/// trajectory are then the optimum's, and its costs are empty. Throws BadInput if the run has an estimator of
/// that name or the reference cannot be made, and std::runtime_error if no optimum is found, or if
/// the observations do not name their landmarks.
ReferenceScore score_reference(const std::string& name, const std::filesystem::path& run,
                               const Summary& summary, const DetailChoices& choices,
                               const seif::Registry& registry);

}  // namespace harness
