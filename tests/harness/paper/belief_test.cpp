#include "harness/paper/belief.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/stream/log_description.hpp"

namespace harness {
namespace {

/// The robot and two landmarks: one is linked to the robot, and the two are linked.
Eigen::MatrixXd two_links() {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(7, 7);
  M.diagonal() << 4, 9, 1, 16, 4, 1, 25;
  M(3, 0) = M(0, 3) = -2;  // |-2| / sqrt(16 * 4)
  M(4, 1) = M(1, 4) = 0.6;
  M(5, 4) = M(4, 5) = 1;  // 1 / sqrt(1 * 4)
  return M;
}

TEST(Normalised, DividesByTheRootsOfTheDiagonal) {
  const Eigen::MatrixXd M = normalised(two_links());
  EXPECT_DOUBLE_EQ(M(3, 0), 0.25);
  EXPECT_DOUBLE_EQ(M(0, 3), 0.25);
  EXPECT_DOUBLE_EQ(M(4, 1), 0.1);
  EXPECT_DOUBLE_EQ(M(5, 4), 0.5);
  EXPECT_TRUE(M.diagonal().isOnes(1e-15));
  EXPECT_EQ(M(6, 5), 0.0);
}

TEST(Links, AreTheBlocksThatAreNotZeroTheWeakestFirst) {
  const std::vector<NetworkLink> links = links_of(normalised(two_links()));
  ASSERT_EQ(links.size(), 2U);
  EXPECT_EQ(links[0].from, robot);
  EXPECT_EQ(links[0].to, 0);
  EXPECT_DOUBLE_EQ(links[0].strength, 0.25) << "the strongest of the block";
  EXPECT_EQ(links[1].from, 0);
  EXPECT_EQ(links[1].to, 1);
  EXPECT_DOUBLE_EQ(links[1].strength, 0.5);
}

LiveEstimator estimator(const std::string& type) {
  LogDescription log;
  log.start.covariance.setIdentity();
  const std::vector<worlds::EstimatorChoice> choices = {test::choice(type)};
  return std::move(make_estimators(test::test_registry(), choices, log, 1).front());
}

/// A landmark straight ahead, seen once.
seif::Scan one_landmark() {
  return {.t = 1.0,
          .observations = {{.landmark = 7,
                            .range = 2.0,
                            .bearing = 0.0,
                            .covariance = Eigen::Vector2d(0.25, 1.0).asDiagonal()}}};
}

TEST(BeliefOf, IsTheSameInCovarianceAndInInformationForm) {
  const std::vector<TrueLandmark> truth = {{3, {9, 9}, 0.1}, {7, {2.5, 0.0}, 0.1}};
  for (const std::string type : {"ekf", "seif_report"}) {
    const LiveEstimator live = estimator(type);
    live.filter->measurement_update(one_landmark(), [](seif::Stage) {});
    const Belief belief = belief_of(live, truth, {.x = 0.1, .y = 0.0, .theta = 0.0});
    EXPECT_EQ(belief.estimator, type);
    EXPECT_EQ(belief.pose.true_pose.x, 0.1);
    ASSERT_EQ(belief.landmarks.size(), 1U);
    EXPECT_LT((belief.landmarks[0].est_point - Eigen::Vector2d(2.0, 0.0)).norm(), 1e-12);
    EXPECT_EQ(belief.landmarks[0].true_point.x(), 2.5);
    // The variances of the pose are 1. Along the ray the range adds its own variance. Across it the heading
    // adds 2^2, and the bearing as much again.
    ASSERT_EQ(belief.covariance.rows(), 5);
    EXPECT_NEAR(belief.covariance(3, 3), 1.25, 1e-9) << type;
    EXPECT_NEAR(belief.covariance(4, 4), 9.0, 1e-9) << type;
    EXPECT_NEAR(belief.covariance(4, 2), 2.0, 1e-9) << type;
    EXPECT_NEAR(belief.information(3, 3), 4.0, 1e-9) << type;
    EXPECT_NEAR(belief.information(4, 4), 0.25, 1e-9) << type;
  }
}

std::string complaint_of(const LiveEstimator& live) {
  try {
    static_cast<void>(belief_of(live, {}, {}));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(BeliefOf, SaysWhyAnEstimatorCannotBeDrawn) {
  LiveEstimator live = estimator("ekf");
  live.failure = "at 3 s: gave up";
  EXPECT_EQ(complaint_of(live), "the belief of ekf cannot be drawn: it failed at 3 s: gave up");
  live.failure.clear();
  EXPECT_EQ(complaint_of(live), "");
  live.filter->measurement_update(one_landmark(), [](seif::Stage) {});
  EXPECT_NE(complaint_of(live).find("a landmark that the world does not have"), std::string::npos);
  EXPECT_NE(complaint_of(estimator("dead_reckoning")).find("keeps no matrix"), std::string::npos);
}

}  // namespace
}  // namespace harness
