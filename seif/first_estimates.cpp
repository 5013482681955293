#include "seif/first_estimates.hpp"

namespace seif {

Eigen::Vector2d FirstEstimates::move_pose(const Pose2& before, const Pose2& after) {
  const Pose2 from = pose_;
  const Pose2 carried = from * (inverse(before) * after);
  const FramedPose framed = pose_among(active_, after, carried, sighting_sd_);
  pose_ = framed.pose;
  const Pose2 to = framed.another_frame ? carried : framed.pose;  // a change of frame is not a motion
  return {to.x - from.x, to.y - from.y};
}

}  // namespace seif
