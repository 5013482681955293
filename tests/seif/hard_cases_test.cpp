// Situations in which filters fail, tested with every filter: no filter throws, and every belief stays proper.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "dense_oracle.hpp"
#include "every_filter.hpp"
#include "ring_drive.hpp"

namespace seif {
namespace {

using test::ignore;
using test::proper_belief;

using Sights = std::vector<std::pair<LandmarkId, Eigen::Vector2d>>;  // landmarks and where they are

/// A robot on a circle of 2 m inside a circle of twelve landmarks. It sees those within 4 m.
class HardCase : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { filter = make(false); }

  std::unique_ptr<Estimator> make(bool is_linear) const {
    const EstimatorSetup setup{.start = {.mean = truth, .covariance = start_covariance},
                               .T_robot_sensor = T_robot_sensor,
                               .random = std::mt19937_64(5)};
    return test::make(GetParam(), setup, is_linear);
  }

  Pose2 sensor() const { return truth * T_robot_sensor; }

  Sights in_view() const {
    Sights sights;
    for (LandmarkId landmark = 0; landmark < 12; ++landmark) {
      const Eigen::Vector2d p(5.0 * std::cos(0.5 * landmark), 5.0 * std::sin(0.5 * landmark));
      if ((inverse(sensor()) * p).norm() < 4.0) sights.emplace_back(landmark, p);
    }
    return sights;
  }

  void move() {
    Odometry u{.t = ++t, .T_previous_current = {0.2, 0.0, 0.1}, .covariance = random.odometry().covariance};
    truth = truth * u.T_previous_current;
    u.T_previous_current.x += random.uniform(-0.02, 0.02);
    u.T_previous_current.theta += random.uniform(-0.02, 0.02);
    filter->motion_update(u);
  }

  void look(const Sights& sights) {
    Scan scan{.t = t, .observations = {}};
    for (const auto& [landmark, p] : sights) {
      scan.observations.push_back(random.observation(landmark, sensor(), p));
      scan.observations.back().range = std::abs(scan.observations.back().range);
    }
    filter->measurement_update(scan, ignore);
  }

  void drive(int steps) {
    for (int k = 0; k < steps; ++k) {
      move();
      look(in_view());
    }
  }

  Eigen::Vector2d estimate(LandmarkId landmark) const {
    const std::vector<LandmarkEstimate> map = filter->map();
    return std::ranges::find(map, landmark, &LandmarkEstimate::landmark)->mean;
  }

  void expect_near_truth(double position, double heading) const {
    const Pose2 error = inverse(truth) * filter->pose();
    EXPECT_LT(std::hypot(error.x, error.y), position);
    EXPECT_LT(std::abs(error.theta), heading);
  }

  const Eigen::Matrix3d start_covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal();
  const Pose2 T_robot_sensor{0.15, -0.05, 0.2};
  Pose2 truth{2.0, 0.0, 1.6};
  double t = 0.0;
  oracle::RandomDrive random{3};
  std::unique_ptr<Estimator> filter;
};

INSTANTIATE_TEST_SUITE_P(All, HardCase, testing::ValuesIn(test::every_filter()), test::name_of);

TEST_P(HardCase, ALandmarkSeenOnceAndNeverAgainStaysInTheMap) {
  const Eigen::Vector2d p(1.0, 3.0);
  const Eigen::Vector2d beside = p + Eigen::Vector2d(0.1, 0.0);
  Sights once = in_view();
  once.emplace_back(98, beside);
  once.emplace_back(99, p);
  look(once);
  for (int k = 0; k < 120; ++k) {  // twice round
    move();
    Sights sights = in_view();
    if ((inverse(sensor()) * beside).norm() < 4.0) sights.emplace_back(98, beside);
    look(sights);
  }
  const auto marginals = proper_belief(*filter);
  ASSERT_TRUE(marginals);
  EXPECT_EQ(filter->map().size(), 14U);
  EXPECT_LT((estimate(98) - beside).norm(), 0.1);
  EXPECT_LT((estimate(99) - p).norm(), 0.2);
  ASSERT_EQ(filter->map()[once.size() - 1].landmark, 99);  // in the order in which they joined
  EXPECT_GT(marginals->landmarks[once.size() - 1].trace(),
            1.1 * marginals->landmarks[once.size() - 2].trace());
}

TEST_P(HardCase, TwoLandmarksMayStandAtOnePlace) {
  const Eigen::Vector2d p(0.5, 0.5);
  for (int k = 0; k < 60; ++k) {
    move();
    Sights sights = in_view();
    sights.emplace_back(50, p);
    sights.emplace_back(51, p);
    look(sights);
  }
  ASSERT_TRUE(proper_belief(*filter));
  EXPECT_LT((estimate(50) - estimate(51)).norm(), 0.1);
  EXPECT_LT((estimate(50) - p).norm(), 0.1);
}

TEST_P(HardCase, LandmarksAtTheSensorAreTaken) {
  drive(10);
  for (int k = 0; k < 10; ++k) {
    const Pose2 T_world_sensor = sensor();
    Scan scan{.t = t, .observations = {}};
    for (const auto& [landmark, p] : in_view()) {
      scan.observations.push_back(random.observation(landmark, T_world_sensor, p));
    }
    // One landmark is a tenth of a millimetre away, and one is exactly at the sensor, where the bearing is
    // arbitrary.
    for (const auto& [landmark, range, bearing] : {std::tuple(50, 1e-4, 0.7), std::tuple(51, 0.0, -2.1)}) {
      Observation z{.landmark = landmark, .range = range, .bearing = bearing + random.uniform(-0.02, 0.02)};
      z.covariance << 0.0025, 0.0002, 0.0002, 0.0004;
      scan.observations.push_back(z);
    }
    filter->measurement_update(scan, ignore);
    ASSERT_TRUE(proper_belief(*filter));
  }
  drive(10);
  ASSERT_TRUE(proper_belief(*filter));
  expect_near_truth(0.3, 0.2);
}

TEST_P(HardCase, ARobotThatNeverMovesStaysAsSureOfItsPoseAsItBegan) {
  for (int k = 0; k < 200; ++k) {
    filter->motion_update({.t = ++t, .T_previous_current = {}, .covariance = Eigen::Matrix3d::Zero()});
    look(in_view());
  }
  const auto marginals = proper_belief(*filter);
  ASSERT_TRUE(marginals);
  // No scan tells where in the world the robot stands, and no noise makes this more uncertain.
  EXPECT_LT((marginals->pose - start_covariance).norm(), 0.01 * start_covariance.norm());
  expect_near_truth(0.05, 0.02);
  for (const auto& [landmark, p] : in_view()) EXPECT_LT((estimate(landmark) - p).norm(), 0.1);
}

TEST_P(HardCase, AHundredObservationsInOneScanAreTaken) {
  for (int k = 0; k < 5; ++k) {
    move();
    Sights sights;
    for (LandmarkId landmark = 0; landmark < 100; ++landmark) {
      sights.emplace_back(landmark, Eigen::Vector2d(landmark % 10 - 4.5, landmark / 10 - 4.5));
    }
    look(sights);
  }
  ASSERT_TRUE(proper_belief(*filter));
  EXPECT_EQ(filter->map().size(), 100U);
  // The filters that keep theta_x links drop 94 landmarks in view, and then treat the pose, given the six
  // others, as independent of them. This is wrong by whole standard deviations, also under the modified rule.
  // The poses of these filters soon have errors of a radian; a dense implementation of (50) gives the same. A
  // bound on the links does not bound the number of landmarks in view. The other filters keep the landmarks in
  // view, or cut no link.
  const auto drops_in_view = {"seif_report", "seif_exact", "seif_modified"};
  if (std::ranges::find(drops_in_view, GetParam()) == drops_in_view.end()) expect_near_truth(0.1, 0.05);
}

// The noise of the linearisation does not become smaller with the sensor's.
TEST_P(HardCase, ALandmarkTwiceInOneScanCountsTwice) {
  const std::unique_ptr<Estimator> once = make(true);
  filter = make(true);
  for (int k = 0; k < 3; ++k) {  // new at first, then known
    Scan twice{.t = t, .observations = {}};
    Scan sharper = twice;  // one observation with half the covariance: the same information
    for (const auto& [landmark, p] : in_view()) {
      const Observation z = random.observation(landmark, sensor(), p);
      twice.observations.insert(twice.observations.end(), 2, z);
      sharper.observations.push_back(z);
      sharper.observations.back().covariance /= 2.0;
    }
    filter->measurement_update(twice, ignore);
    once->measurement_update(sharper, ignore);
    const auto marginals = proper_belief(*filter);
    const auto expected = proper_belief(*once);
    ASSERT_TRUE(marginals && expected);
    ASSERT_EQ(marginals->landmarks.size(), expected->landmarks.size());
    EXPECT_LT((marginals->pose - expected->pose).norm(), 1e-9 * expected->pose.norm());
    for (std::size_t i = 0; i < expected->landmarks.size(); ++i) {
      EXPECT_LT((marginals->landmarks[i] - expected->landmarks[i]).norm(),
                1e-9 * expected->landmarks[i].norm());
    }
  }
}

TEST_P(HardCase, AnEmptyScanTellsNothing) {
  look({});
  EXPECT_TRUE(filter->map().empty());
  drive(30);
  const auto before = proper_belief(*filter);
  const std::size_t landmarks = filter->map().size();
  const Pose2 pose = filter->pose();
  look({});
  const auto after = proper_belief(*filter);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(filter->map().size(), landmarks);
  EXPECT_LT((after->pose - before->pose).norm(), 1e-9 * before->pose.norm());
  EXPECT_NEAR(filter->pose().x, pose.x, 1e-2);  // the mean recovery may continue
  double last = after->pose.determinant();
  for (int k = 0; k < 20; ++k) {
    move();
    look({});
    const auto blind = proper_belief(*filter);
    ASSERT_TRUE(blind);
    EXPECT_GT(blind->pose.determinant(), last);
    last = blind->pose.determinant();
  }
}

}  // namespace
}  // namespace seif
