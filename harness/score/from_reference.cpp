#include "harness/score/from_reference.hpp"

#include "harness/score/true_names.hpp"

namespace harness {

DistanceFromReference distance_from_reference(const std::filesystem::path& folder, const std::string& name,
                                              const ReferenceEstimate& reference) {
  DistanceFromReference distance;
  distance.landmarks = score_points(pair_landmarks(read_scored_map(folder, name).landmarks, reference.map));
  std::vector<PosePair> poses;
  auto at = reference.trajectory.begin();
  for (const TimedPose& pose : read_trajectory(folder, name)) {
    while (at != reference.trajectory.end() && at->t < pose.t) ++at;
    if (at == reference.trajectory.end()) break;
    if (at->t == pose.t) poses.push_back({pose.t, pose.T_world_robot, at->T_world_robot});
  }
  distance.trajectory = absolute_trajectory_error(poses);
  return distance;
}

}  // namespace harness
