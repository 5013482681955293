// The rigid motion of a part of the map, and of the clusters that it may be soft between.
#include "seif/tree/body_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace seif {
namespace {

constexpr double fit_near = 8.0;        // [m]
constexpr double fit_rounding = 1e-10;  // [m, rad]

const std::vector<Eigen::Vector2d> body_places{{100.0, 0.0}, {103.0, 1.0}, {101.0, 4.0}, {98.0, 2.0}};

Eigen::Vector2d moved(const Eigen::Vector2d& p, double angle, const Eigen::Vector2d& by) {
  return Eigen::Rotation2Dd(angle) * p + by;
}

TEST(BodyFit, FindsTheMotionOfOneCluster) {
  BodyFit fit;
  fit.begin(fit_near);
  for (const Eigen::Vector2d& p : body_places) fit.add(p, moved(p, 0.2, {1.0, 2.0}));
  const BodyMotion motion = fit.fit();
  EXPECT_NEAR(motion.angle, 0.2, fit_rounding);
  EXPECT_FALSE(fit.is_by_clusters());
  for (std::size_t i = 0; i < body_places.size(); ++i) {
    EXPECT_LT((motion.moved(body_places[i]) - moved(body_places[i], 0.2, {1.0, 2.0})).norm(), fit_rounding);
    EXPECT_LT(fit.step(i).norm(), fit_rounding);
  }
}

TEST(BodyFit, OfNothingOrOnePointIsNoTurn) {
  BodyFit fit;
  fit.begin(fit_near);
  EXPECT_TRUE(fit.fit().is_identity());
  fit.add({1.0, 2.0}, {5.0, 5.0});
  EXPECT_TRUE(fit.fit().is_identity());
  EXPECT_LT(fit.step(0).norm(), fit_rounding);
}

/// Far from each other, and each turned by its own angle: the whole has turned by the mean. In its frame the clusters
/// have turned by the rest, along the tangent, and have not been strained.
TEST(BodyFit, ClustersTurnEachByItsOwnAngle) {
  const Eigen::Vector2d far(300.0, 50.0);
  BodyFit fit;
  fit.begin(fit_near);
  for (const Eigen::Vector2d& p : body_places) fit.add(p, moved(p, 0.1, {0.0, 0.0}));
  for (const Eigen::Vector2d& p : body_places) fit.add(p + far, moved(p + far, 0.3, {-7.0, 2.0}));
  const BodyMotion motion = fit.fit();
  EXPECT_TRUE(fit.is_by_clusters());
  EXPECT_NEAR(motion.angle, 0.2, fit_rounding);
  const Eigen::Vector2d lever = body_places[1] - body_places[0];
  const Eigen::Vector2d tangent(-lever.y(), lever.x());
  EXPECT_LT((fit.step(1) - fit.step(0) - (-0.1) * tangent).norm(), fit_rounding);
  EXPECT_LT((fit.step(5) - fit.step(4) - 0.1 * tangent).norm(), fit_rounding);
}

TEST(BodyFit, PointsInReachOfOneAnotherAreOneClusterInAnyOrder) {
  BodyFit fit;
  fit.begin(fit_near);
  for (const double x : {0.0, 14.0, 7.0}) fit.add({x, 0.0}, {x, 1.0});
  fit.fit();
  EXPECT_EQ(fit.points()[0].cluster, fit.points()[1].cluster);
  EXPECT_EQ(fit.points()[0].cluster, fit.points()[2].cluster);
}

/// Two ends of a ring whose error puts one beside the other, until the closure moves it.
TEST(BodyFit, EndsSideBySideByChanceAreNotOneCluster) {
  const Eigen::Vector2d beside(0.0, 5.0);
  for (const Eigen::Vector2d& by : {Eigen::Vector2d(23.0, 0.0), Eigen::Vector2d(3.0, -2.0)}) {
    BodyFit fit;
    fit.begin(fit_near);
    for (const Eigen::Vector2d& p : body_places) fit.add(p, p);
    for (const Eigen::Vector2d& p : body_places)
      fit.add(p + beside, moved(p, 0.1, {0.0, -10.0}) + beside + by);
    fit.fit();
    EXPECT_NE(fit.points()[0].cluster, fit.points()[4].cluster);
    EXPECT_EQ(fit.points()[4].cluster, fit.points()[7].cluster);
  }
}

/// One pair of landmarks of two ends is as far apart after the closure as before it.
TEST(BodyFit, EndsThatKeepADistanceByChanceAreNotOneCluster) {
  BodyFit fit;
  fit.begin(fit_near);
  const Eigen::Vector2d beside(103.0, 6.0);  // five metres from body_places[1], before and after
  for (const Eigen::Vector2d& p : body_places) fit.add(p, p);
  fit.add(beside, beside + Eigen::Vector2d(5.0, -5.0));
  fit.fit();
  EXPECT_NE(fit.points()[1].cluster, fit.points()[4].cluster);
}

TEST(BodyFit, AGroupTellsItsOwnTurn) {
  BodyFit fit;
  fit.begin(fit_near);
  fit.add({0.0, 0.0}, {0.0, 0.0});
  fit.add_turned({50.0, 0.0}, {50.0, 5.0}, 0.4);
  EXPECT_NEAR(fit.fit().angle, 0.4, fit_rounding);
}

TEST(BodyFit, ATurnOfAHalfCircleIsFound) {
  BodyFit fit;
  fit.begin(fit_near);
  for (const Eigen::Vector2d& p : body_places) fit.add(p, moved(p, 3.1, {0.0, 0.0}));
  EXPECT_NEAR(fit.fit().angle, 3.1, fit_rounding);
}

}  // namespace
}  // namespace seif
