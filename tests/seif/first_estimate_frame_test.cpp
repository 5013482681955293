// The pose in the frame of the first estimates, and which levers are used there.

#include "seif/first_estimate_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/linearisation.hpp"
#include "seif/models.hpp"

namespace seif {
namespace {

const Pose2 pose{3.0, 1.0, 0.4};
const Pose2 turned_and_moved{40.0, -7.0, 0.1};  // T_first_mean
constexpr double sighting_sd = 0.05;            // [m]

/// Landmarks around the robot that have all moved together from their first estimates.
std::vector<FirstEstimate> landmarks_moved_by(const Pose2& T_first_mean, int count, double phase) {
  std::vector<FirstEstimate> landmarks;
  for (int k = 0; k < count; ++k) {
    const double angle = phase + 1.3 * k;
    const Eigen::Vector2d mean(pose.x + (2.0 + 0.2 * k) * std::cos(angle), pose.y + 3.0 * std::sin(angle));
    landmarks.push_back({.mean = mean, .first = T_first_mean * mean});
  }
  return landmarks;
}

void expect_equal_poses(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(wrap_angle(a.theta - b.theta), 0.0, 1e-12);
}

TEST(FirstEstimateFrame, IsTheRigidMotionFromMeansToFirstEstimates) {
  std::vector<FirstEstimate> landmarks = landmarks_moved_by(turned_and_moved, 5, 0.0);
  const Pose2 truth = turned_and_moved * pose;
  const FramedPose framed =
      pose_among(landmarks, pose, {truth.x + 0.1, truth.y - 0.1, truth.theta}, sighting_sd);
  expect_equal_poses(framed.pose, truth);
  EXPECT_FALSE(framed.another_frame);
}

TEST(FirstEstimateFrame, IsCarriedAlongWhereLessThanTwoLandmarksTellIt) {
  std::vector<FirstEstimate> landmarks = landmarks_moved_by(turned_and_moved, 1, 0.0);
  const Pose2 carried{41.0, -6.0, 0.2};
  expect_equal_poses(pose_among(landmarks, pose, carried, sighting_sd).pose, carried);
  expect_equal_poses(pose_among({}, pose, carried, sighting_sd).pose, carried);
}

TEST(FirstEstimateFrame, IsThatOfTheMostOnceALoopIsClosed) {
  const Pose2 beginning{-60.0, 25.0, -0.05};
  for (const int of_the_beginning : {1, 2, 3, 4, 5, 6}) {
    std::vector<FirstEstimate> landmarks = landmarks_moved_by(turned_and_moved, 4, 0.0);
    for (const FirstEstimate& landmark : landmarks_moved_by(beginning, of_the_beginning, 0.5)) {
      landmarks.push_back(landmark);
    }
    const FramedPose framed = pose_among(landmarks, pose, turned_and_moved * pose, sighting_sd);
    expect_equal_poses(framed.pose, (of_the_beginning > 4 ? beginning : turned_and_moved) * pose);
    EXPECT_EQ(framed.another_frame, of_the_beginning > 4);
  }
}

TEST(FirstEstimateFrame, IsKeptWhereTheOthersDoNotAgree) {
  std::vector<FirstEstimate> landmarks = landmarks_moved_by(turned_and_moved, 3, 0.0);
  for (int k = 0; k < 6; ++k) {
    landmarks.push_back({.mean = {3.0 + k, 4.0}, .first = {100.0 * k * k, -30.0 * (k % 2)}});
  }
  const FramedPose framed = pose_among(landmarks, pose, turned_and_moved * pose, sighting_sd);
  expect_equal_poses(framed.pose, turned_and_moved * pose);
  EXPECT_FALSE(framed.another_frame);
}

/// Six active landmarks, seen from the origin. The last two have been moved since their first estimates, by
/// `moved` [m].
InformationState closed_loop(double moved = 50.0) {
  InformationState state({.mean = {}, .covariance = 0.01 * Eigen::Matrix3d::Identity()});
  state.first_estimates().settle_after(1);
  state.first_estimates().note_sighting_sd(sighting_sd);
  for (int k = 0; k < 6; ++k) {
    const Eigen::Vector2d p(3.0 * std::cos(1.0 * k), 3.0 * std::sin(1.0 * k));
    state.activate(state.add_landmark(k, k < 4 ? p : Eigen::Vector2d(p.x() + moved, p.y())));
  }
  for (const int slot : {4, 5}) state.move_landmark(slot, {-moved, 0.0});
  move_to_prediction(state, {0.1, 0.0, 0.0});
  return state;
}

TEST(FirstEstimateFrame, LeversAreBetweenFirstEstimatesWhereTheseAreNearAndBetweenMeansElsewhere) {
  const InformationState state = closed_loop();
  const Pose2 at = linearisation_pose(state);
  for (int slot = 0; slot < 6; ++slot) {
    const Eigen::Vector2d between_means = state.mean(slot) - Eigen::Vector2d(0.1, 0.0);
    const Eigen::Vector2d between_firsts = linearisation_point(state, slot) - Eigen::Vector2d(at.x, at.y);
    EXPECT_EQ(lever(state, slot, state.mean(slot)), slot < 4 ? between_firsts : between_means);
    EXPECT_EQ((between_firsts - between_means).norm() > 1.0, slot >= 4);
  }
  const std::optional<Pose2> other = other_linearisation_pose(state);
  ASSERT_TRUE(other);
  EXPECT_NEAR(other->x, 50.1, 1e-12);
}

// At a distance of 3 m, 0.5 m is ten standard deviations of a sighting, and a sixth of the lever.
TEST(FirstEstimateFrame, IsAnotherOneAsSoonAsNoNoiseExplainsIt) {
  EXPECT_TRUE(other_linearisation_pose(closed_loop(0.5)));
  EXPECT_FALSE(other_linearisation_pose(closed_loop(0.2)));
}

TEST(FirstEstimateFrame, ALandmarkIsSettledOnceItHasALinkToAPassiveOne) {
  for (const bool linked : {false, true}) {
    InformationState state({.mean = {}, .covariance = 0.01 * Eigen::Matrix3d::Identity()});
    state.first_estimates().settle_after(5);
    for (const int slot : {0, 1}) state.activate(state.add_landmark(slot, {3.0, 1.0 + slot}));
    state.Omega().block<2, 2>(3, 5).setIdentity();
    state.Omega().block<2, 2>(5, 3).setIdentity();
    if (linked) state.deactivate(1);
    state.move_landmark(0, {0.01, 0.0});
    update_first_estimates(state);
    EXPECT_DOUBLE_EQ(linearisation_point(state, 0).x(), linked ? 3.0 : 3.01);
  }
}

TEST(FirstEstimateFrame, NewLandmarksHaveTheirFirstEstimateWhereTheyAreFromThePoseAmongThem) {
  InformationState state = closed_loop();
  for (int slot = 0; slot < 4; ++slot) state.move_landmark(slot, {0.0, 8.0});
  state.move_robot({0.0, 8.0, 0.0});  // an update has moved the robot and all that is near it
  move_to_prediction(state, {0.1, 8.0, 0.0});
  const int slot = state.add_landmark(99, {2.0, 9.0});
  EXPECT_LT((linearisation_point(state, slot) - Eigen::Vector2d(2.0, 1.0)).norm(), 1e-9);
  EXPECT_LT((lever(state, slot, state.mean(slot)) - Eigen::Vector2d(1.9, 1.0)).norm(), 1e-9);
}

}  // namespace
}  // namespace seif
