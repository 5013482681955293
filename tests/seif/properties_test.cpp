// Properties of every filter: the results do not depend on the choice of the world frame, nor on where the
// heading wraps.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "every_filter.hpp"
#include "ring_drive.hpp"

namespace seif {
namespace {

using test::ignore;
using test::RingDrive;

constexpr double property_rounding = 1e-10;  // relative to metres and radians, after some hundred updates

/// The matrix (3 x 3) that turns vectors [x y theta] as T_to_from does.
Eigen::Matrix3d rotation_of_pose(const Pose2& T_to_from) {
  Eigen::Matrix3d G = Eigen::Matrix3d::Identity();
  G.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(T_to_from.theta).toRotationMatrix();
  return G;
}

/// The same robot, described in another world frame.
EstimatorSetup in_frame(EstimatorSetup setup, const Pose2& T_to_from) {
  const Eigen::Matrix3d G = rotation_of_pose(T_to_from);
  setup.start.mean = T_to_from * setup.start.mean;
  setup.start.covariance = G * setup.start.covariance * G.transpose();
  return setup;
}

EstimatorSetup setup_of(const RingDrive& drive) {
  EstimatorSetup setup = drive.setup();
  setup.start.covariance << 2e-4, 5e-5, 1e-5, 5e-5, 1e-4, -2e-5, 1e-5, -2e-5, 1e-4;  // no axis is special
  setup.T_robot_sensor = {0.1, 0.05, 0.0};
  return setup;
}

class EveryFilter : public testing::TestWithParam<std::string> {
 protected:
  /// Two filters of the kind; the second one's world frame is T_to_from away.
  void begin(const Pose2& T_to_from) {
    here = test::make(GetParam(), setup_of(drive));
    there = test::make(GetParam(), in_frame(setup_of(drive), T_to_from));
  }

  void step() {
    drive.advance();
    for (Estimator* filter : {here.get(), there.get()}) {
      filter->motion_update(drive.odometry());
      filter->measurement_update(drive.scan(), ignore);
    }
  }

  RingDrive drive{40, 11};
  std::unique_ptr<Estimator> here;
  std::unique_ptr<Estimator> there;
};

INSTANTIATE_TEST_SUITE_P(All, EveryFilter, testing::ValuesIn(test::every_filter()), test::name_of);

void expect_equal(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR(a.x, b.x, property_rounding);
  EXPECT_NEAR(a.y, b.y, property_rounding);
  EXPECT_NEAR(wrap_angle(a.theta - b.theta), 0.0, property_rounding);
}

TEST_P(EveryFilter, ARigidMotionOfTheWorldFrameMovesPoseMapAndCovariancesAndNothingElse) {
  const Pose2 T_there_here{30.0, -20.0, 2.1};
  begin(T_there_here);
  for (int k = 0; k < 2 * drive.steps_for_a_round(); ++k) {
    step();
    expect_equal(there->pose(), T_there_here * here->pose());
  }
  const Counts counts_here = here->counts();
  const Counts counts_there = there->counts();
  EXPECT_EQ(counts_there.blocks_touched, counts_here.blocks_touched);
  EXPECT_EQ(counts_there.active_landmarks, counts_here.active_landmarks);
  EXPECT_EQ(counts_there.links, counts_here.links);
  EXPECT_EQ(counts_there.relocations, counts_here.relocations);

  const auto map_here = here->map();
  const auto map_there = there->map();
  const auto marginals_here = test::proper_belief(*here);
  const auto marginals_there = test::proper_belief(*there);
  ASSERT_TRUE(marginals_here && marginals_there);
  ASSERT_EQ(map_there.size(), map_here.size());
  const Eigen::Matrix3d G = rotation_of_pose(T_there_here);
  const auto relative = [](const auto& a, const auto& b) { return (a - b).norm() / b.norm(); };
  EXPECT_LT(relative(marginals_there->pose, G * marginals_here->pose * G.transpose()), property_rounding);
  const Eigen::Matrix2d R = G.topLeftCorner<2, 2>();
  for (std::size_t i = 0; i < map_here.size(); ++i) {
    EXPECT_EQ(map_there[i].landmark, map_here[i].landmark);
    EXPECT_LT((map_there[i].mean - T_there_here * map_here[i].mean).norm(), property_rounding);
    const Eigen::Matrix2d turned = R * marginals_here->landmarks[i] * R.transpose();
    EXPECT_LT(relative(marginals_there->landmarks[i], turned), property_rounding);
  }
}

TEST_P(EveryFilter, TheHeadingWrapsAtPiWithoutATrace) {
  const Pose2 quarter_turn{0.0, 0.0, std::numbers::pi / 2};
  begin(quarter_turn);
  std::vector<int> wraps_here;  // steps at which the heading jumped by a full turn
  std::vector<int> wraps_there;
  for (int k = 0; k < 2 * drive.steps_for_a_round(); ++k) {
    const double before_here = here->pose().theta;
    const double before_there = there->pose().theta;
    step();
    expect_equal(there->pose(), quarter_turn * here->pose());
    for (const auto& [filter, before, wraps] : {std::tuple(here.get(), before_here, &wraps_here),
                                                std::tuple(there.get(), before_there, &wraps_there)}) {
      const double heading = filter->pose().theta;
      EXPECT_GT(heading, -std::numbers::pi);
      EXPECT_LE(heading, std::numbers::pi);
      EXPECT_LT(std::abs(wrap_angle(heading - before)), 0.3);  // a step of the ring turns by 0.1
      if (std::abs(heading - before) > std::numbers::pi) wraps->push_back(k);
    }
  }
  EXPECT_GE(wraps_here.size(), 2U);  // two rounds; the filter that begins at pi itself wraps there, too
  EXPECT_GE(wraps_there.size(), 2U);
  EXPECT_NE(wraps_here, wraps_there);
}

}  // namespace
}  // namespace seif
