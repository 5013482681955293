#include "seif/first_estimates.hpp"

#include <algorithm>

namespace seif {

Eigen::Vector2d FirstEstimates::move_pose(const Pose2& before, const Pose2& after) {
  const Pose2 from = pose_;
  const Pose2 carried = from * (inverse(before) * after);
  const FramedPose framed = pose_among(active_, after, carried, sighting_sd_);
  pose_ = framed.pose;
  const Pose2 to = framed.another_frame ? carried : framed.pose;  // a change of frame is not a motion
  return {to.x - from.x, to.y - from.y};
}

std::size_t FirstEstimates::fitting(const Pose2& framed, const Pose2& mean) const {
  const Eigen::Vector2d there(framed.x, framed.y);
  const Eigen::Vector2d here(mean.x, mean.y);
  return static_cast<std::size_t>(std::ranges::count_if(active_, [&](const FirstEstimate& landmark) {
    return are_levers_alike(landmark.first - there, landmark.mean - here, sighting_sd_);
  }));
}

/// The scan may have moved the pose among the landmarks, or the landmarks with the pose.
Eigen::Vector2d FirstEstimates::follow_pose(const Pose2& before, const Pose2& after) {
  const Pose2 from = pose_;
  const Pose2 carried = from * (inverse(before) * after);
  const Pose2& nearer = fitting(carried, after) > fitting(from, after) ? carried : from;
  const FramedPose framed = pose_among(active_, after, nearer, sighting_sd_);
  if (framed.another_frame || fitting(framed.pose, after) < active_.size()) return Eigen::Vector2d::Zero();
  pose_ = framed.pose;
  return {pose_.x - from.x, pose_.y - from.y};
}

}  // namespace seif
