// Groups that turn and change their size.
#include "seif/tree/group_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace seif {
namespace {

/// A landmark that hangs on a small group, which hangs on a large one, goes where the large one takes it.
TEST(GroupMotion, AGroupInAGroupTakesItsMembersAlong) {
  const Lever to_group(40.0, -25.0);
  const Lever to_landmark(3.0, 7.0);
  const GroupMotion d(0.3, -0.2, 0.4, 0.1);
  for (const bool turning : {false, true}) {
    const Eigen::Vector2d by_group = end_step(to_landmark, tied_motion(to_group, d, turning), turning);
    const Eigen::Vector2d at_once = end_step(to_group + to_landmark, d, turning);
    EXPECT_LT((by_group + Eigen::Vector2d(to_group) - at_once - Eigen::Vector2d(to_group)).norm(), 1e-12);
  }
}

TEST(GroupMotion, TurnsAlongACircle) {
  const Lever lever(5.0, 1.0);
  const Eigen::Vector2d end = Eigen::Vector2d(lever) + end_step(lever, {0.0, 0.0, 1.2, 0.0}, true);
  EXPECT_LT((end - Eigen::Rotation2Dd(1.2) * Eigen::Vector2d(lever)).norm(), 1e-12);
}

TEST(GroupMotion, KeepsItsShape) {
  const Lever a(5.0, 1.0);
  const Lever b(-2.0, 3.0);
  const GroupMotion d(7.0, -1.0, 0.9, 0.25);
  const Eigen::Vector2d apart = Eigen::Vector2d(a - b) + end_step(a, d, true) - end_step(b, d, true);
  EXPECT_NEAR(apart.norm(), 1.25 * (a - b).norm(), 1e-12);
}

}  // namespace
}  // namespace seif
