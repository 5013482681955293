// Groups that are strained evenly.
#include "seif/tree/group_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace seif {
namespace {

GroupMotion small_motion() { return (GroupMotion() << 0.3, -0.2, 1e-4, 2e-4, -3e-4, 1e-4).finished(); }

/// A landmark that hangs on a small group, which hangs on a large one, goes where the large one takes it.
TEST(GroupMotion, AGroupInAGroupTakesItsMembersAlong) {
  const Eigen::Vector2d to_group(40.0, -25.0);
  const Eigen::Vector2d to_landmark(3.0, 7.0);
  const Lever of_group{.arm = to_group, .turn = 0.4, .own_turn = -0.9};
  const Lever in_group{.arm = to_landmark, .turn = -0.9};
  const Lever direct{.arm = to_group + to_landmark, .turn = 0.4};
  for (const bool turning : {false, true}) {
    const GroupMotion d = small_motion();
    const Eigen::Vector2d by_group = end_step(in_group, tied_motion(of_group, d, turning), turning);
    const Eigen::Vector2d at_once = end_step(direct, d, turning);
    EXPECT_LT((by_group - at_once).norm(), turning ? 1e-6 : 1e-14);  // [m] a turn of 1e-4 of the strain
  }
}

TEST(GroupMotion, TurnsAlongACircle) {
  GroupMotion d = GroupMotion::Zero();
  d(2) = 1.2;
  const Lever lever{.arm = {5.0, 1.0}};
  const Eigen::Vector2d end = lever.arm + end_step(lever, d, true);
  EXPECT_LT((end - Eigen::Rotation2Dd(1.2) * Eigen::Vector2d(lever.arm)).norm(), 1e-12);
}

/// The axes of the strain turn with the group: turned first or strained first, the shape is the same.
TEST(GroupMotion, StrainsInAxesThatTurnWithTheGroup) {
  GroupMotion turn = GroupMotion::Zero();
  turn(2) = 0.7;
  GroupMotion strain = GroupMotion::Zero();
  strain.tail<3>() << 1e-3, -2e-3, 5e-4;
  const Lever lever{.arm = {5.0, 1.0}};
  const Eigen::Vector2d turned = lever.arm + end_step(lever, turn, true);
  const Eigen::Vector2d turned_first = turned + end_step({.arm = turned, .turn = 0.7}, strain, true);
  const Eigen::Vector2d strained = lever.arm + end_step(lever, strain, true);
  const Eigen::Vector2d strained_first = strained + end_step({.arm = strained}, turn, true);
  EXPECT_LT((turned_first - strained_first).norm(), 1e-12);
}

}  // namespace
}  // namespace seif
