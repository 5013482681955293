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

/// From the landmarks as they lie about the first of them: where most of them fit, pose_among() has the best turn.
void FirstEstimates::put_pose(const Pose2& at) {
  if (active_.empty()) return;
  Pose2 best = at;
  std::size_t most = 0;
  for (const FirstEstimate& landmark : active_) {
    const Eigen::Vector2d by = landmark.first - landmark.mean;
    const Pose2 carried{at.x + by.x(), at.y + by.y(), at.theta};
    const std::size_t fit = fitting(carried, at);
    if (fit <= most) continue;
    most = fit;
    best = carried;
  }
  pose_ = pose_among(active_, at, best, sighting_sd_).pose;
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
