#include "sensors/wheel_arc.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace sensors {
namespace {

using std::numbers::pi;
constexpr double track = 0.4;

// Straight, almost straight (on either side of where sinc changes to its series), arcs, backwards, on the
// spot, one wheel at rest, no motion, more than a full turn.
constexpr std::array<WheelDistances, 11> motions = {{{0.3, 0.3},
                                                     {0.3, 0.3 + 1e-9},
                                                     {0.3, 0.3 + 0.7e-3},
                                                     {0.3, 0.3 + 0.9e-3},
                                                     {0.1, 0.4},
                                                     {-0.2, -0.5},
                                                     {-0.3, 0.3},
                                                     {0.0, 0.2},
                                                     {0.0, 0.0},
                                                     {0.5, -0.2},
                                                     {-1.0, 2.0}}};

TEST(WheelArc, DrivesCirclesOfTheRightRadius) {
  // Half a turn to the left, with the axle's middle at radius 1: the robot ends on the opposite side of the
  // circle, facing back.
  const WheelArc arc = wheel_arc({pi * (1.0 - 0.5 * track), pi * (1.0 + 0.5 * track)}, track);
  EXPECT_NEAR(arc.T_start_end.x, 0.0, 1e-14);
  EXPECT_NEAR(arc.T_start_end.y, 2.0, 1e-14);
  EXPECT_NEAR(std::abs(arc.T_start_end.theta), pi, 1e-14);
}

// At constant curvature the path can be cut anywhere: the parts compose to the whole.
TEST(WheelArc, IsExactForConstantCurvature) {
  for (const WheelDistances& whole : motions) {
    seif::Pose2 T_start_now;
    constexpr int parts = 7;
    const WheelArc part = wheel_arc({whole.left / parts, whole.right / parts}, track);
    for (int i = 0; i < parts; ++i) {
      T_start_now = T_start_now * part.T_start_end;
    }
    const seif::Pose2 T_start_end = wheel_arc(whole, track).T_start_end;
    EXPECT_NEAR(T_start_now.x, T_start_end.x, 1e-14);
    EXPECT_NEAR(T_start_now.y, T_start_end.y, 1e-14);
    EXPECT_NEAR(seif::wrap_angle(T_start_now.theta - T_start_end.theta), 0.0, 1e-14);
  }
}

TEST(WheelArc, JacobianMatchesCentralDifferences) {
  // The errors of the central difference are step^2 times the third derivative, and rounding divided by step:
  // both about 1e-10.
  constexpr double step = 1e-5;
  constexpr double tolerance = 1e-8;
  for (const WheelDistances& at : motions) {
    Eigen::Matrix<double, 3, 2> numeric;
    for (int wheel = 0; wheel < 2; ++wheel) {
      const double l = wheel == 0 ? step : 0.0;
      const double r = wheel == 1 ? step : 0.0;
      const seif::Pose2 ahead = wheel_arc({at.left + l, at.right + r}, track).T_start_end;
      const seif::Pose2 behind = wheel_arc({at.left - l, at.right - r}, track).T_start_end;
      numeric.col(wheel) << ahead.x - behind.x, ahead.y - behind.y,
          seif::wrap_angle(ahead.theta - behind.theta);
    }
    numeric /= 2.0 * step;
    const WheelArc arc = wheel_arc(at, track);
    EXPECT_LT((arc.J_arc_wrt_wheels - numeric).cwiseAbs().maxCoeff(), tolerance)
        << at.left << ' ' << at.right;
  }
}

}  // namespace
}  // namespace sensors
