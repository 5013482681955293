#include "sim/planar_geometry.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace sim {
namespace {

/// The shortest distance over `steps` + 1 points of the path; never below the true one.
template <class PointDistance>
double sampled(const Segment& way, int steps, const PointDistance& distance_of) {
  double nearest = distance_of(way.start);
  for (int i = 1; i <= steps; ++i) {
    nearest = std::min(nearest, distance_of(way.start + (way.end - way.start) * i / steps));
  }
  return nearest;
}

TEST(PlanarGeometry, HeadingsAreInTheHalfOpenCircle) {
  EXPECT_EQ(heading_of({-1.0, 0.0}), std::numbers::pi);
  EXPECT_EQ(heading_of({-1.0, -0.0}), std::numbers::pi);
  EXPECT_EQ(heading_of({0.0, -2.0}), -std::numbers::pi / 2.0);
  for (const double heading : {-3.1, -1.0, 0.0, 0.5, 3.1}) {
    EXPECT_NEAR(heading_of(direction(heading)), heading, 1e-15);
    EXPECT_NEAR(heading_of(direction(heading + 2.0 * std::numbers::pi)), heading, 1e-14);
  }
}

TEST(PlanarGeometry, DistancesMatchDenselySampledWays) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-3.0, 3.0), size(0.05, 1.0), angle(-3.0, 3.0);
  constexpr int steps = 2000;
  int touching = 0;
  for (int i = 0; i < 1000; ++i) {
    const Segment way{{place(random), place(random)}, {place(random), place(random)}};
    const Disk disk{{place(random), place(random)}, size(random)};
    const Rectangle rectangle{{place(random), place(random)}, angle(random), {size(random), size(random)}};
    const Eigen::Rotation2Dd R_box_world(-rectangle.heading);
    const auto to_disk = [&](const Eigen::Vector2d& p) {
      return std::max(0.0, (p - disk.centre).norm() - disk.radius);
    };
    const auto to_rectangle = [&](const Eigen::Vector2d& p) {
      const Eigen::Vector2d local = R_box_world * (p - rectangle.centre);
      return (local - local.cwiseMax(-rectangle.half_size).cwiseMin(rectangle.half_size)).norm();
    };
    // Along the path, the nearest sample is at most half a step from the nearest point.
    const double tolerance = 0.5 * (way.end - way.start).norm() / steps + 1e-12;
    EXPECT_NEAR(distance(way, disk), sampled(way, steps, to_disk), tolerance);
    EXPECT_NEAR(distance(way, rectangle), sampled(way, steps, to_rectangle), tolerance);
    touching += distance(way, rectangle) == 0.0 ? 1 : 0;
  }
  EXPECT_GT(touching, 100);
  EXPECT_LT(touching, 900);
}

TEST(PlanarGeometry, AWayOfNoLengthIsAPoint) {
  const Eigen::Vector2d p(1.0, 0.0);
  EXPECT_DOUBLE_EQ(distance({p, p}, Disk{{4.0, 4.0}, 2.0}), 3.0);
  EXPECT_DOUBLE_EQ(distance({p, p}, Rectangle{{4.0, 4.0}, 0.0, {0.5, 0.5}}), std::hypot(2.5, 3.5));
  EXPECT_EQ(distance({p, p}, Rectangle{{1.2, 0.1}, 0.7, {0.5, 0.5}}), 0.0);
}

}  // namespace
}  // namespace sim
