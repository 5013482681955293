#include "sensors/wheel_encoders.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "sensors/random_stream.hpp"

namespace sensors {
namespace {

using std::numbers::pi;

WheelEncoderOptions exact() {
  WheelEncoderOptions options;
  options.ticks_per_revolution = 0;
  return options;
}

WheelEncoders encoders(const WheelEncoderOptions& options, std::uint64_t seed = 1) {
  return {options, random_stream(seed, "encoders")};
}

TEST(WheelEncoders, WithoutErrorsReadTheTrueMotion) {
  const WheelEncoderOptions options = exact();
  WheelEncoders sensor = encoders(options);
  seif::Pose2 T_start_now;
  for (int i = 1; i <= 200; ++i) {
    const seif::Odometry odometry = sensor.read(0.05 * i, 0.2 * i, 0.3 * i);
    EXPECT_EQ(odometry.t, 0.05 * i);
    EXPECT_EQ(odometry.covariance.norm(), 0.0);
    T_start_now = T_start_now * odometry.T_previous_current;
  }
  const seif::Pose2 T_start_end = wheel_arc({4.0, 6.0}, options.track).T_start_end;
  EXPECT_NEAR(T_start_now.x, T_start_end.x, 1e-12);
  EXPECT_NEAR(T_start_now.y, T_start_end.y, 1e-12);
  EXPECT_NEAR(T_start_now.theta, T_start_end.theta, 1e-12);
}

// Each reading rolls a third of a tick: most readings are zero, but no part of the way is lost.
TEST(WheelEncoders, CarryTheRemainderOfATick) {
  WheelEncoderOptions options;
  WheelEncoders sensor = encoders(options);
  const double tick = 2.0 * pi / options.ticks_per_revolution;
  constexpr int readings = 30000;
  double distance = 0.0;
  int still = 0;
  for (int i = 1; i <= readings; ++i) {
    const double angle = tick * (i / 3.0);
    const double x = sensor.read(i, angle, angle).T_previous_current.x;
    distance += x;
    still += x == 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(distance, options.wheel_radius * tick * readings / 3.0, options.wheel_radius * tick);
  EXPECT_NEAR(still, 2.0 * readings / 3.0, 2.0);
}

TEST(WheelEncoders, ReadWholeTicks) {
  WheelEncoderOptions options;
  options.ticks_per_revolution = 100;
  WheelEncoders sensor = encoders(options);
  const double tick_length = options.wheel_radius * 2.0 * pi / 100;
  for (int i = 1; i <= 500; ++i) {
    const double angle = 3.0 * std::sin(0.01 * i);
    const double ticks = sensor.read(i, angle, angle).T_previous_current.x / tick_length;
    EXPECT_NEAR(ticks, std::round(ticks), 1e-9);
  }
}

// When the robot turns by theta on the spot, the wheels roll -+ b theta / 2. Divided by the assumed track b /
// E_b, this is read as E_b theta: the only error is (E_b - 1) theta in the heading.
TEST(WheelEncoders, TrackRatioScalesEveryTurn) {
  WheelEncoderOptions options = exact();
  options.track_ratio = 1.02;
  WheelEncoders sensor = encoders(options);
  constexpr double turn = 2.0 * pi;
  const double angle = 0.5 * options.track * turn / options.wheel_radius;
  const seif::Pose2 read = sensor.read(1.0, -angle, angle).T_previous_current;
  EXPECT_NEAR(read.theta, (options.track_ratio - 1.0) * turn, 1e-12);
  EXPECT_NEAR(std::hypot(read.x, read.y), 0.0, 1e-15);

  WheelEncoders straight = encoders(options);
  EXPECT_NEAR(straight.read(1.0, 10.0, 10.0).T_previous_current.theta, 0.0, 1e-15);
}

// A straight line of length L turns both wheels by L / r. Read with the assumed radii r (E_d + 1) / 2 on the
// left and r (1/E_d + 1) / 2 on the right, it is an arc of length L (2 + E_d + 1/E_d) / 4 that turns by L
// (1/E_d - E_d) / (2 b): to the right for E_d > 1.
TEST(WheelEncoders, DiameterRatioBendsAStraightLine) {
  WheelEncoderOptions options = exact();
  options.diameter_ratio = 1.01;
  const double E_d = options.diameter_ratio;
  WheelEncoders sensor = encoders(options);
  constexpr double length = 10.0;
  const double angle = length / options.wheel_radius;
  const seif::Pose2 read = sensor.read(1.0, angle, angle).T_previous_current;

  const double turn = 0.5 * length * (1.0 / E_d - E_d) / options.track;
  const double radius = length * (2.0 + E_d + 1.0 / E_d) / 4.0 / turn;
  EXPECT_LT(read.theta, 0.0);
  EXPECT_NEAR(read.theta, turn, 1e-12);
  EXPECT_NEAR(read.x, radius * std::sin(turn), 1e-12);
  EXPECT_NEAR(read.y, radius * (1.0 - std::cos(turn)), 1e-12);
}

// The mean diameter is unchanged: Borenstein's E_d changes only the ratio, so a straight line keeps its length
// to second order, (E_d + 1/E_d - 2) / 4 = 2.5e-5 for one per cent.
TEST(WheelEncoders, DiameterRatioKeepsTheLengthOfTheWay) {
  WheelEncoderOptions options = exact();
  options.diameter_ratio = 1.01;
  WheelEncoders sensor = encoders(options);
  const seif::Pose2 read = sensor.read(1.0, 1.0, 1.0).T_previous_current;
  EXPECT_NEAR(std::hypot(read.x, read.y) / options.wheel_radius, 1.0, 2.6e-5 + 1e-5);
}

struct Moments {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d reported = Eigen::Matrix3d::Zero();  // mean of the reported covariances
};

/// The moments of the increments of one motion that is read many times.
Moments moments(const WheelEncoderOptions& options, double left, double right, int samples) {
  WheelEncoders sensor = encoders(options);
  Moments m;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (int i = 1; i <= samples; ++i) {
    const seif::Odometry odometry = sensor.read(i, left * i, right * i);
    const seif::Pose2& T = odometry.T_previous_current;
    const Eigen::Vector3d increment(T.x, T.y, T.theta);
    m.mean += increment;
    squares += increment * increment.transpose();
    m.reported += odometry.covariance;
  }
  m.mean /= samples;
  m.reported /= samples;
  m.covariance = squares / samples - m.mean * m.mean.transpose();
  return m;
}

// A sample variance of n normal values has a relative standard deviation of sqrt(2/n) = 1 % for n = 20,000. A
// covariance has at most this fraction of sqrt(var_a var_b). Five of these are allowed. The bend of the noise
// by the arc is less: its second-order share is (sd / track)^2, below 1e-4 here.
TEST(WheelEncoders, ReportTheCovarianceThatTheirIncrementsHave) {
  WheelEncoderOptions options = exact();
  options.distance_sd = 0.005;
  constexpr int samples = 20000;
  const double tolerance = 5.0 * std::sqrt(2.0 / samples);
  const Moments m = moments(options, 0.5, 0.8, samples);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double scale = std::sqrt(m.reported(i, i) * m.reported(j, j));
      EXPECT_NEAR(m.covariance(i, j), m.reported(i, j), tolerance * scale) << i << ' ' << j;
    }
  }
  const seif::Pose2 T = wheel_arc({0.05, 0.08}, options.track).T_start_end;
  const Eigen::Vector3d sd_of_mean = (m.reported.diagonal() / samples).cwiseSqrt();
  EXPECT_NEAR(m.mean.x(), T.x, 5.0 * sd_of_mean.x());
  EXPECT_NEAR(m.mean.z(), T.theta, 5.0 * sd_of_mean.z());
}

// The random error of a wheel is a random walk: variance sd^2 L after the length L, with or without ticks. So
// the heading, (right - left) / b, has the variance 2 sd^2 L / b^2. A variance from 400 runs has a relative
// standard deviation of sqrt(2/400) = 7 %; four of them are allowed.
TEST(WheelEncoders, RandomErrorGathersWithTheDistance) {
  WheelEncoderOptions options;
  options.distance_sd = 0.01;
  constexpr int runs = 400;
  constexpr int readings = 50;
  constexpr double length = 4.0;
  double squares = 0.0;
  for (int run = 0; run < runs; ++run) {
    WheelEncoders sensor = encoders(options, static_cast<std::uint64_t>(run));
    double heading = 0.0;
    for (int i = 1; i <= readings; ++i) {
      const double angle = length / options.wheel_radius * i / readings;
      heading += sensor.read(i, angle, angle).T_previous_current.theta;
    }
    squares += heading * heading;
  }
  const double variance =
      2.0 * options.distance_sd * options.distance_sd * length / (options.track * options.track);
  EXPECT_NEAR(squares / runs, variance, 4.0 * std::sqrt(2.0 / runs) * variance);
}

TEST(WheelEncoders, CovarianceHasRankTwoAndCountsTheTick) {
  WheelEncoderOptions options;
  options.distance_sd = 0.005;
  WheelEncoders sensor = encoders(options);
  const seif::Odometry odometry = sensor.read(1.0, 2.0, 3.0);
  Eigen::FullPivLU<Eigen::Matrix3d> lu(odometry.covariance);
  lu.setThreshold(1e-12);
  EXPECT_EQ(lu.rank(), 2);

  // At rest only the tick is left: theta = (right - left) / b, so var = 2 (tick^2 / 12) / b^2.
  const double tick_length = options.wheel_radius * 2.0 * pi / options.ticks_per_revolution;
  const double at_rest = sensor.read(2.0, 2.0, 3.0).covariance(2, 2);
  EXPECT_NEAR(at_rest, tick_length * tick_length / 6.0 / (options.track * options.track), 1e-18);
}

TEST(WheelEncoders, ReadNothingWhenTheWheelsRest) {
  WheelEncoderOptions options;
  options.distance_sd = 0.005;
  WheelEncoders sensor = encoders(options);
  sensor.read(1.0, 2.0, 3.0);
  for (int i = 0; i < 100; ++i) {
    const seif::Pose2 T = sensor.read(2.0 + i, 2.0, 3.0).T_previous_current;
    EXPECT_EQ(T.x, 0.0);
    EXPECT_EQ(T.y, 0.0);
    EXPECT_EQ(T.theta, 0.0);
  }
}

TEST(WheelEncoders, RefuseWhatMakesNoSense) {
  const auto refused = [](auto change) {
    WheelEncoderOptions options;
    change(options);
    EXPECT_THROW(encoders(options), std::invalid_argument);
  };
  refused([](WheelEncoderOptions& o) { o.wheel_radius = 0.0; });
  refused([](WheelEncoderOptions& o) { o.track = -0.4; });
  refused([](WheelEncoderOptions& o) { o.ticks_per_revolution = -1; });
  refused([](WheelEncoderOptions& o) { o.distance_sd = std::numeric_limits<double>::quiet_NaN(); });
  refused([](WheelEncoderOptions& o) { o.diameter_ratio = 0.0; });
  refused([](WheelEncoderOptions& o) { o.track_ratio = -1.0; });
  WheelEncoders sensor = encoders(exact());
  EXPECT_THROW(sensor.read(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace sensors
