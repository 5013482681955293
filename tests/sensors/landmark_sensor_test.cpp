#include "sensors/landmark_sensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <vector>

#include "sensors/random_stream.hpp"

namespace sensors {
namespace {

using std::numbers::pi;
constexpr seif::LandmarkId first_false_id = 1000;

const LineOfSight always = [](const Eigen::Vector2d&, seif::LandmarkId) { return true; };

LandmarkSensorOptions options_with_false_ids() {
  LandmarkSensorOptions options;
  options.first_false_id = first_false_id;
  return options;
}

struct Seen {
  seif::Scan scan;
  std::vector<seif::LandmarkId> true_ids;
};

/// One scan by a fresh sensor.
Seen look(const LandmarkSensorOptions& options, const std::vector<LandmarkTruth>& landmarks,
          const seif::Pose2& T_world_robot = {}, const LineOfSight& line_of_sight = always) {
  LandmarkSensor sensor(options, random_stream(1, "landmark_sensor"));
  Seen seen;
  sensor.scan(0.0, T_world_robot, landmarks, line_of_sight, seen.scan, seen.true_ids);
  return seen;
}

bool sees(const LandmarkSensorOptions& options, const Eigen::Vector2d& p_world,
          const seif::Pose2& T_world_robot = {}) {
  return !look(options, {{0, p_world}}, T_world_robot).scan.observations.empty();
}

Eigen::Vector2d polar(double range, double bearing) {
  return {range * std::cos(bearing), range * std::sin(bearing)};
}

TEST(LandmarkSensor, SeesUpToItsRange) {
  const LandmarkSensorOptions options = options_with_false_ids();
  EXPECT_TRUE(sees(options, {8.0, 0.0}));
  EXPECT_TRUE(sees(options, polar(7.999999, 2.5)));
  EXPECT_FALSE(sees(options, polar(8.000001, 2.5)));
}

TEST(LandmarkSensor, SeesWithinItsFieldOfView) {
  LandmarkSensorOptions options = options_with_false_ids();
  EXPECT_TRUE(sees(options, {-5.0, 0.0}));  // a full field of view: straight behind, too
  options.fov = 2.0;
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(sees(options, polar(5.0, side * 0.999999)));
    EXPECT_FALSE(sees(options, polar(5.0, side * 1.000001)));
  }
}

TEST(LandmarkSensor, MeasuresFromWhereItIsMounted) {
  LandmarkSensorOptions options = options_with_false_ids();
  options.T_robot_sensor = {0.3, -0.1, pi / 2};
  options.range_sd = 1e-9;
  options.bearing_sd = 1e-9;
  // Robot at (2, 1) facing north: the sensor sits at (2.1, 1.3) and faces west.
  const seif::Pose2 T_world_robot{2.0, 1.0, pi / 2};
  Eigen::Vector2d p_world_sensor = Eigen::Vector2d::Zero();
  const LineOfSight remember = [&](const Eigen::Vector2d& p, seif::LandmarkId) {
    p_world_sensor = p;
    return true;
  };
  const Seen seen = look(options, {{4, {2.1 - 3.0, 1.3 - 3.0}}}, T_world_robot, remember);
  ASSERT_EQ(seen.scan.observations.size(), 1U);
  EXPECT_NEAR(p_world_sensor.x(), 2.1, 1e-14);
  EXPECT_NEAR(p_world_sensor.y(), 1.3, 1e-14);
  // South-west is to the left of a sensor that faces west. The noise of 1e-9 is allowed eight deviations.
  EXPECT_NEAR(seen.scan.observations[0].range, std::sqrt(18.0), 8e-9);
  EXPECT_NEAR(seen.scan.observations[0].bearing, pi / 4, 8e-9);

  options.max_range = 1.0;
  EXPECT_TRUE(sees(options, {2.1, 2.2}, T_world_robot));    // 1.2 m from the robot, 0.9 m from the sensor
  EXPECT_FALSE(sees(options, {2.0, 0.25}, T_world_robot));  // 0.75 m from the robot, 1.05 m from the sensor
}

TEST(LandmarkSensor, DoesNotSeeWhatIsHidden) {
  const LineOfSight odd_only = [](const Eigen::Vector2d&, seif::LandmarkId id) { return id % 2 == 1; };
  const Seen seen =
      look(options_with_false_ids(), {{1, {1, 0}}, {2, {2, 0}}, {3, {3, 0}}, {4, {4, 0}}}, {}, odd_only);
  EXPECT_EQ(seen.true_ids, (std::vector<seif::LandmarkId>{1, 3}));
  ASSERT_EQ(seen.scan.observations.size(), 2U);
  EXPECT_EQ(seen.scan.observations[0].landmark, 1);
  EXPECT_EQ(seen.scan.observations[1].landmark, 3);
}

// The mean of n samples has the sd sigma / sqrt(n), their sample sd has the relative sd 1 / sqrt(2 n), and
// their correlation has the sd 1 / sqrt(n). Five sd of each are allowed.
TEST(LandmarkSensor, NoiseHasTheStatedMeanAndDeviation) {
  LandmarkSensorOptions options = options_with_false_ids();
  options.range_sd = 0.05;
  options.range_sd_per_m = 0.02;
  options.bearing_sd = 0.01;
  LandmarkSensor sensor(options, random_stream(3, "landmark_sensor"));
  const std::vector<LandmarkTruth> landmarks = {{0, polar(6.0, pi - 0.001)}};  // the noise crosses +-pi
  const double range_sd = std::hypot(0.05, 0.02 * 6.0);
  constexpr int n = 40000;
  double sum_r = 0.0, sum_rr = 0.0, sum_b = 0.0, sum_bb = 0.0, sum_rb = 0.0;
  Seen seen;
  for (int i = 0; i < n; ++i) {
    sensor.scan(i, {}, landmarks, always, seen.scan, seen.true_ids);
    ASSERT_EQ(seen.scan.observations.size(), 1U);
    const seif::Observation& z = seen.scan.observations[0];
    EXPECT_GT(z.bearing, -pi);
    EXPECT_LE(z.bearing, pi);
    const double r = (z.range - 6.0) / range_sd;
    const double b = seif::wrap_angle(z.bearing - (pi - 0.001)) / options.bearing_sd;
    sum_r += r, sum_rr += r * r, sum_b += b, sum_bb += b * b, sum_rb += r * b;
  }
  const double bound = 5.0 / std::sqrt(n);
  EXPECT_NEAR(sum_r / n, 0.0, bound);
  EXPECT_NEAR(sum_b / n, 0.0, bound);
  EXPECT_NEAR(std::sqrt(sum_rr / n), 1.0, bound / std::sqrt(2.0));
  EXPECT_NEAR(std::sqrt(sum_bb / n), 1.0, bound / std::sqrt(2.0));
  EXPECT_NEAR(sum_rb / n, 0.0, bound);
}

TEST(LandmarkSensor, HandsOnTheCovarianceAtTheMeasuredRange) {
  LandmarkSensorOptions options = options_with_false_ids();
  options.range_sd_per_m = 0.1;
  options.false_detections = 3.0;
  LandmarkSensor sensor(options, random_stream(3, "landmark_sensor"));
  Seen seen;
  for (int i = 0; i < 100; ++i) {
    sensor.scan(i, {}, std::vector<LandmarkTruth>{{0, {5.0, 0.0}}}, always, seen.scan, seen.true_ids);
    for (const seif::Observation& z : seen.scan.observations) {
      EXPECT_DOUBLE_EQ(z.covariance(0, 0), 0.05 * 0.05 + 0.01 * z.range * z.range);
      EXPECT_DOUBLE_EQ(z.covariance(1, 1), options.bearing_sd * options.bearing_sd);
      EXPECT_EQ(z.covariance(0, 1), 0.0);
      EXPECT_EQ(z.covariance(1, 0), 0.0);
    }
  }
}

// A binomial count of n trials has the sd sqrt(n p (1 - p)); five of them are allowed.
TEST(LandmarkSensor, MissesAtItsRate) {
  LandmarkSensorOptions options = options_with_false_ids();
  options.miss_probability = 0.2;
  LandmarkSensor sensor(options, random_stream(4, "landmark_sensor"));
  const std::vector<LandmarkTruth> landmarks = {{0, {1, 0}}, {1, {2, 1}}};
  constexpr int scans = 10000;
  int reported[2] = {0, 0};
  Seen seen;
  for (int i = 0; i < scans; ++i) {
    sensor.scan(i, {}, landmarks, always, seen.scan, seen.true_ids);
    for (const seif::LandmarkId id : seen.true_ids) {
      ++reported[id];
    }
  }
  const double bound = 5.0 * std::sqrt(scans * 0.2 * 0.8);
  EXPECT_NEAR(reported[0], 0.8 * scans, bound);
  EXPECT_NEAR(reported[1], 0.8 * scans, bound);
}

// Counts are Poisson distributed: mean and variance lambda, with sd sqrt(lambda / n) and about lambda sqrt((2 +
// 1/lambda) / n). Positions are uniform over the area, so (range / max)^2 and the bearing are uniform: means
// 1/2 and 0 with sd 1/sqrt(12). The square of the first has the mean 1/3 and the sd sqrt(4/45). Five sd of each
// are allowed.
TEST(LandmarkSensor, FalseDetectionsArePoissonAndUniformOverTheField) {
  LandmarkSensorOptions options = options_with_false_ids();
  options.false_detections = 1.5;
  options.fov = 3.0;
  LandmarkSensor sensor(options, random_stream(5, "landmark_sensor"));
  constexpr int scans = 20000;
  double count = 0.0, count_squared = 0.0, area = 0.0, area_squared = 0.0, bearing = 0.0;
  Seen seen;
  for (int i = 0; i < scans; ++i) {
    sensor.scan(i, {}, {}, always, seen.scan, seen.true_ids);
    const auto k = static_cast<double>(seen.scan.observations.size());
    count += k;
    count_squared += k * k;
    for (const seif::Observation& z : seen.scan.observations) {
      EXPECT_LE(z.range, options.max_range);
      EXPECT_LE(std::abs(z.bearing), 0.5 * options.fov);
      const double share = std::pow(z.range / options.max_range, 2);
      area += share;
      area_squared += share * share;
      bearing += z.bearing / options.fov;
    }
  }
  const double mean = count / scans;
  EXPECT_NEAR(mean, 1.5, 5.0 * std::sqrt(1.5 / scans));
  EXPECT_NEAR(count_squared / scans - mean * mean, 1.5, 5.0 * 1.5 * std::sqrt((2.0 + 1.0 / 1.5) / scans));
  const double bound = 5.0 / std::sqrt(12.0 * count);
  EXPECT_NEAR(area / count, 0.5, bound);
  EXPECT_NEAR(area_squared / count, 1.0 / 3.0,
              bound);  // sd of a squared uniform: sqrt(4/45) = 0.298 > 1/sqrt(12)
  EXPECT_NEAR(bearing / count, 0.0, bound);
}

TEST(LandmarkSensor, FalseDetectionsHaveIdsThatNothingElseHas) {
  LandmarkSensorOptions options = options_with_false_ids();
  options.false_detections = 2.0;
  LandmarkSensor sensor(options, random_stream(6, "landmark_sensor"));
  seif::LandmarkId expected = first_false_id;
  Seen seen;
  for (int i = 0; i < 100; ++i) {
    sensor.scan(i, {}, std::vector<LandmarkTruth>{{3, {1, 1}}}, always, seen.scan, seen.true_ids);
    ASSERT_EQ(seen.true_ids.size(), seen.scan.observations.size());
    EXPECT_EQ(seen.true_ids[0], 3);
    EXPECT_EQ(seen.scan.observations[0].landmark, 3);
    for (std::size_t k = 1; k < seen.true_ids.size(); ++k) {
      EXPECT_EQ(seen.true_ids[k], seif::no_landmark);
      EXPECT_EQ(seen.scan.observations[k].landmark, expected++);
    }
  }
  EXPECT_GT(expected, first_false_id);
}

TEST(LandmarkSensor, MayWithholdItsIdsAndMeasuresTheSame) {
  LandmarkSensorOptions options = options_with_false_ids();
  options.false_detections = 1.0;
  const std::vector<LandmarkTruth> landmarks = {{0, {1, 1}}, {4, {2, -1}}};
  const Seen named = look(options, landmarks);
  options.hides_ids = true;
  const Seen nameless = look(options, landmarks);
  EXPECT_EQ(nameless.true_ids, named.true_ids);
  ASSERT_EQ(nameless.scan.observations.size(), named.scan.observations.size());
  for (std::size_t k = 0; k < named.scan.observations.size(); ++k) {
    EXPECT_EQ(nameless.scan.observations[k].landmark, seif::no_landmark);
    EXPECT_EQ(nameless.scan.observations[k].range, named.scan.observations[k].range);
  }
}

TEST(LandmarkSensor, MisreadsAsOftenAsItIsTold) {
  LandmarkSensorOptions options;
  options.first_false_id = 20;
  options.misread_probability = 0.1;
  std::vector<LandmarkTruth> landmarks;
  for (seif::LandmarkId id = 0; id < 10; ++id) landmarks.push_back({id, polar(4.0, 0.3 * id)});
  LandmarkSensor sensor(options, random_stream(11, "landmark_sensor"));
  constexpr int scans = 1000;
  int misread = 0;
  std::set<seif::LandmarkId> read_as;
  Seen seen;
  for (int i = 0; i < scans; ++i) {
    sensor.scan(i, {}, landmarks, always, seen.scan, seen.true_ids);
    std::set<seif::LandmarkId> ids;
    for (std::size_t k = 0; k < seen.true_ids.size(); ++k) {
      const seif::LandmarkId id = seen.scan.observations[k].landmark;
      EXPECT_TRUE(ids.insert(id).second) << "twice in a scan";
      ASSERT_TRUE(id >= 0 && id < 20);
      if (id == seen.true_ids[k]) continue;
      ++misread;
      read_as.insert(id);
    }
  }
  EXPECT_NEAR(misread, 1000, 4 * 30);  // sd of a binomial: sqrt(10000 * 0.1 * 0.9) = 30
  EXPECT_GE(read_as.size(), 10U) << "all that are not in the scan";
}

TEST(LandmarkSensor, NeverMeasuresARangeBelowZero) {
  LandmarkSensorOptions options = options_with_false_ids();
  options.range_sd = 0.5;
  LandmarkSensor sensor(options, random_stream(7, "landmark_sensor"));
  Seen seen;
  for (int i = 0; i < 2000; ++i) {
    sensor.scan(i, {}, std::vector<LandmarkTruth>{{0, {0.1, 0.0}}}, always, seen.scan, seen.true_ids);
    EXPECT_GE(seen.scan.observations.at(0).range, 0.0);
  }
}

// Candidates that are out of range, out of view or hidden draw no random numbers; a missed landmark draws as
// many as a detected one.
TEST(LandmarkSensor, DrawsForVisibleLandmarksAlone) {
  LandmarkSensorOptions options = options_with_false_ids();
  options.fov = pi;
  const LineOfSight not_nine = [](const Eigen::Vector2d&, seif::LandmarkId id) { return id != 9; };
  const Seen few = look(options, {{1, {2, 0}}, {2, {3, 1}}}, {}, not_nine);
  const Seen many =
      look(options, {{7, {20, 0}}, {1, {2, 0}}, {8, {-2, 0}}, {9, {4, 1}}, {2, {3, 1}}, {9, {1, 1}}}, {},
           not_nine);
  ASSERT_EQ(few.scan.observations.size(), 2U);
  ASSERT_EQ(many.scan.observations.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(few.scan.observations[k].range, many.scan.observations[k].range);
    EXPECT_EQ(few.scan.observations[k].bearing, many.scan.observations[k].bearing);
  }

  LandmarkSensorOptions missing = options;
  missing.miss_probability = 0.5;
  LandmarkSensor all(options, random_stream(8, "landmark_sensor"));
  LandmarkSensor some(missing, random_stream(8, "landmark_sensor"));
  int missed = 0;
  Seen a, b;
  for (int i = 0; i < 100; ++i) {
    const std::vector<LandmarkTruth> one = {{1, {2, 0}}};
    all.scan(i, {}, one, always, a.scan, a.true_ids);
    some.scan(i, {}, one, always, b.scan, b.true_ids);
    if (b.scan.observations.empty()) {
      ++missed;
    } else {
      EXPECT_EQ(a.scan.observations[0].range, b.scan.observations[0].range);
    }
  }
  EXPECT_GT(missed, 20);
  EXPECT_LT(missed, 80);
}

TEST(LandmarkSensor, RefusesWhatMakesNoSense) {
  const auto refused = [](auto change) {
    LandmarkSensorOptions options;
    change(options);
    EXPECT_THROW(LandmarkSensor(options, random_stream(1, "x")), std::invalid_argument);
  };
  refused([](LandmarkSensorOptions& o) { o.max_range = 0.0; });
  refused([](LandmarkSensorOptions& o) { o.fov = 7.0; });
  refused([](LandmarkSensorOptions& o) { o.range_sd = 0.0; });
  refused([](LandmarkSensorOptions& o) { o.bearing_sd = -0.1; });
  refused([](LandmarkSensorOptions& o) { o.range_sd_per_m = -0.1; });
  refused([](LandmarkSensorOptions& o) { o.miss_probability = 1.1; });
  refused([](LandmarkSensorOptions& o) { o.misread_probability = -0.1; });
  refused([](LandmarkSensorOptions& o) { o.false_detections = -1.0; });
}

}  // namespace
}  // namespace sensors
