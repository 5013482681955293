// The distance of an estimate from a reference. It replaces the error where the truth is not known.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/score/score_folder.hpp"

namespace harness {

/// The map and trajectory of a reference. The map is sorted by landmark id.
struct ReferenceEstimate {
  std::vector<TrueLandmark> map;
  std::vector<TimedPose> trajectory;
};

struct DistanceFromReference {
  PointScore landmarks;   // [m] over the landmarks that both maps have
  PointScore trajectory;  // [m] over the positions at the times that both trajectories have
};

/// Compares the estimator's map and trajectory in a run folder with the reference. Throws BadInput.
DistanceFromReference distance_from_reference(const std::filesystem::path& folder, const std::string& name,
                                              const ReferenceEstimate& reference);

}  // namespace harness
