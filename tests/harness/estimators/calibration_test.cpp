#include "harness/estimators/calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"
#include "harness/stream/log_stream.hpp"
#include "seif/models.hpp"

namespace harness {
namespace {

/// A robot that drives circles among twelve landmarks; the noise has exactly these values.
CalibrationLog drawn_log(const NoiseValues& values, unsigned seed, int steps) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const LogNoise noise = noise_of(values);
  CalibrationLog log;
  log.start.covariance = 1e-6 * Eigen::Matrix3d::Identity();
  seif::Pose2 pose;
  for (int step = 0; step < steps; ++step) {
    const seif::Pose2 moved{0.2, 0.0, step % 200 < 100 ? 0.06 : 0.0};
    const Eigen::Matrix3d R = covariance(*noise.odometry, moved);
    CalibrationLog::Event motion;
    motion.is_motion = true;
    motion.T_previous_current = moved;
    log.events.push_back(motion);
    pose =
        pose * seif::Pose2{moved.x + std::sqrt(R(0, 0)) * normal(random), std::sqrt(R(1, 1)) * normal(random),
                           moved.theta + std::sqrt(R(2, 2)) * normal(random)};
    for (int i = 0; i < 4; ++i) {
      CalibrationLog::Event seen;
      const double angle = 1.7 * (4 * step + i);
      seen.p_world_landmark =
          Eigen::Vector2d(pose.x, pose.y) +
          (2.0 + 6.0 * std::abs(std::sin(angle))) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const Eigen::Vector2d z = seif::predict_observation(pose, {}, seen.p_world_landmark).z;
      const Eigen::Matrix2d Q = covariance(*noise.sensor, z(0));
      seen.observation.range = z(0) + std::sqrt(Q(0, 0)) * normal(random);
      seen.observation.bearing = seif::wrap_angle(z(1) + std::sqrt(Q(1, 1)) * normal(random));
      seen.begins_scan = i == 0;
      log.events.push_back(seen);
      ++log.observations;
    }
  }
  return log;
}

const LogNoise guess{OdometryNoise{0.02, 0.02, 0.02, 0.02}, SensorNoise{0.1, 0.02, 0.02}};

TEST(Calibrate, ReturnsTheNoiseThatWasDrawnWithinItsStandardErrors) {
  const NoiseValues truth = {0.05, 0.03, 0.02, 0.06, 0.04, 0.01, 0.012};
  const Calibration found = calibrate({drawn_log(truth, 1, 1500), drawn_log(truth, 2, 1500)}, guess);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(std::abs(found.values[i] - truth[i]), 3.0 * found.standard_errors[i]) << i;
    EXPECT_LT(found.standard_errors[i], 0.3 * truth[i]) << i;  // the data contain enough information
  }
  EXPECT_LE(found.outliers, 2);
}

TEST(Calibrate, FindsZeroWhereThereIsNone) {
  const NoiseValues truth = {0.05, 0.0, 0.02, 0.0, 0.04, 0.0, 0.012};
  const Calibration found = calibrate({drawn_log(truth, 3, 1500)}, guess);
  for (const std::size_t i : {0U, 2U, 4U, 6U})
    EXPECT_LT(std::abs(found.values[i] - truth[i]), 3.0 * found.standard_errors[i]) << i;
  // A value that is not estimated as zero is within three of its standard errors of zero.
  for (const std::size_t i : {1U, 3U, 5U}) EXPECT_LE(found.values[i], 3.0 * found.standard_errors[i]) << i;
}

TEST(Calibrate, PutsOutliersAside) {
  const NoiseValues truth = {0.05, 0.03, 0.02, 0.06, 0.04, 0.01, 0.012};
  CalibrationLog log = drawn_log(truth, 4, 1500);
  int spoilt = 0;
  for (std::size_t i = 50; i < log.events.size(); i += 97) {
    if (log.events[i].is_motion) continue;
    log.events[i].observation.bearing += 2.0;
    ++spoilt;
  }
  const Calibration found = calibrate({log}, guess);
  EXPECT_NEAR(static_cast<double>(found.outliers), spoilt, 2.0);
  EXPECT_LT(std::abs(found.values[6] - truth[6]), 3.0 * found.standard_errors[6]);
}

TEST(Calibrate, ReturnsTheNoiseOfASimulatedWorld) {
  worlds::World world = test::small_world();
  world.physics.engine = worlds::Engine::kinematic;
  world.duration = 200.0;
  world.encoders.calibrated = true;
  world.encoders.ticks_per_revolution = 0;
  world.estimators.clear();
  const TemporaryFolder folder;
  test::run_live(world, folder.path());
  LogStream log(folder.path());
  const Calibration found = calibrate({read_for_calibration(log)}, guess);
  const double range_sd = world.landmark_sensor.range_sd;
  const double bearing_sd = world.landmark_sensor.bearing_sd;
  // Each wheel has an error of k sqrt(s): the distance then has k / sqrt(2), the heading sqrt(2) k / track.
  const double k = world.encoders.distance_sd;
  EXPECT_LT(std::abs(found.values[0] - k / std::sqrt(2.0)), 3.0 * found.standard_errors[0]);
  EXPECT_LT(std::abs(found.values[2] - k * std::sqrt(2.0) / world.robot.track),
            3.0 * found.standard_errors[2]);
  EXPECT_LT(std::abs(found.values[4] - range_sd), 3.0 * found.standard_errors[4]);
  EXPECT_LT(std::abs(found.values[6] - bearing_sd), 3.0 * found.standard_errors[6]);
}

TEST(ReadForCalibration, RefusesALogInWhichNoKnownLandmarkIsSeen) {
  const TemporaryFolder folder;
  test::run_live(test::small_world(), folder / "run");
  test::write_file(folder / "run" / "landmarks.csv", "landmark,x,y,radius\n900,1,2,0.1\n");
  LogStream log(folder / "run");
  EXPECT_THROW(read_for_calibration(log), BadInput);
}

}  // namespace
}  // namespace harness
