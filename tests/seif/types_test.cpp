#include "seif/types.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace seif {
namespace {

constexpr double pi = std::numbers::pi;

TEST(WrapAngle, MapsToTheHalfOpenIntervalUpToPi) {
  EXPECT_DOUBLE_EQ(wrap_angle(pi), pi);
  EXPECT_DOUBLE_EQ(wrap_angle(-pi), pi);
  EXPECT_DOUBLE_EQ(wrap_angle(3 * pi), pi);
  EXPECT_EQ(wrap_angle(0.0), 0.0);
  EXPECT_NEAR(wrap_angle(pi + 0.1), -pi + 0.1, 1e-15);
  EXPECT_NEAR(wrap_angle(-pi - 0.1), pi - 0.1, 1e-15);
  for (int k = -50; k <= 50; ++k) {
    const double wrapped = wrap_angle(0.37 * k);
    EXPECT_GT(wrapped, -pi);
    EXPECT_LE(wrapped, pi);
    EXPECT_NEAR(std::sin(wrapped), std::sin(0.37 * k), 1e-14);
    EXPECT_NEAR(std::cos(wrapped), std::cos(0.37 * k), 1e-14);
  }
}

TEST(Pose2, ComposesWithItsInverseToTheIdentity) {
  const Pose2 T_a_b{1.5, -2.0, 2.9};
  const Pose2 T_a_a = T_a_b * inverse(T_a_b);
  EXPECT_NEAR(T_a_a.x, 0.0, 1e-15);
  EXPECT_NEAR(T_a_a.y, 0.0, 1e-15);
  EXPECT_NEAR(T_a_a.theta, 0.0, 1e-15);
}

TEST(Pose2, TransformsPointsInTheOrderOfTheFrames) {
  const Pose2 T_a_b{1.0, 2.0, pi / 2};
  const Pose2 T_b_c{3.0, 0.0, pi / 2};
  const Eigen::Vector2d p_c(1.0, 0.0);
  const Eigen::Vector2d p_a = T_a_b * (T_b_c * p_c);
  EXPECT_NEAR(p_a.x(), 0.0, 1e-15);
  EXPECT_NEAR(p_a.y(), 5.0, 1e-15);
  EXPECT_NEAR(((T_a_b * T_b_c) * p_c - p_a).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace seif
