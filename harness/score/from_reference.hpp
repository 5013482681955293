// The distance of an estimate from that of a reference, for runs without truth.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/score/score_folder.hpp"

namespace harness {

/// What a reference says. The map is sorted by landmark.
struct ReferenceEstimate {
  std::vector<TrueLandmark> map;
  std::vector<TimedPose> trajectory;
};

struct DistanceFromReference {
  PointScore landmarks;   // [m] of the landmarks that both have
  PointScore trajectory;  // [m] of the positions at the times that both have
};

/// Compares the estimator's map and trajectory in the folder of a run. Throws BadInput.
DistanceFromReference distance_from_reference(const std::filesystem::path& folder, const std::string& name,
                                              const ReferenceEstimate& reference);

}  // namespace harness
