#include "seif/dense/ekf.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "seif/dense/symmetric_downdate.hpp"
#include "seif/dense_oracle.hpp"
#include "seif/full_state.hpp"
#include "seif/measurement_update.hpp"
#include "seif/motion_update.hpp"

namespace seif {
namespace {

using oracle::RandomDrive;

const EstimatorSetup setup{
    .start = {.mean = {0.5, 1.0, -0.4},
              .covariance = Eigen::Vector3d(0.01, 0.02, 0.005).asDiagonal().toDenseMatrix()},
    .T_robot_sensor = {0.2, 0.1, -0.3},
    .random = {}};

const StageDone ignore = [](Stage) {};

/// A drive past 30 landmarks: the input of both filters.
struct Step {
  Odometry odometry;
  Scan scan;
};

std::vector<Step> drive(unsigned seed, int steps) {
  RandomDrive random(seed);
  Pose2 T_world_robot = setup.start.mean;
  std::vector<Step> drive;
  for (int k = 0; k < steps; ++k) {
    Step step{.odometry = random.odometry(), .scan = {}};
    T_world_robot = T_world_robot * step.odometry.T_previous_current;
    for (int i = 0; i < 4; ++i) {
      const auto landmark = static_cast<LandmarkId>(random.uniform(0, 30));
      const Eigen::Vector2d p_world(0.7 * (landmark % 6) - 2, 0.9 * (landmark / 6) - 2.5);
      step.scan.observations.push_back(
          random.observation(landmark, T_world_robot * setup.T_robot_sensor, p_world));
    }
    drive.push_back(step);
  }
  return drive;
}

TEST(Ekf, EqualsTheSeifWithoutSparsificationAndWithExactMean) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    Ekf ekf(setup);
    InformationState seif(setup.start);
    for (const Step& step : drive(seed, 60)) {
      ekf.motion_update(step.odometry);
      ekf.measurement_update(step.scan, ignore);

      // The EKF linearises known landmarks at the predicted mean, and new ones at the updated mean. Here the
      // SEIF does the same.
      motion_update(seif, step.odometry);
      std::vector<Observation> known;
      std::vector<Observation> unknown;
      for (const Observation& z : step.scan.observations)
        (seif.find(z.landmark) ? known : unknown).push_back(z);
      measurement_update(seif, known, setup.T_robot_sensor);
      oracle::recover_mean(seif);
      for (const Observation& z : unknown) {  // one by one: a new landmark may have been seen twice
        measurement_update(seif, std::span(&z, 1), setup.T_robot_sensor);
        oracle::recover_mean(seif);
      }
    }
    ASSERT_EQ(seif.active_count(), seif.landmark_count());
    const Eigen::MatrixXd Sigma = oracle::inverse(oracle::symmetric(full_Omega(seif)));
    EXPECT_LT((ekf.mu() - full_mu(seif)).norm(), 1e-6);
    EXPECT_LT((ekf.Sigma() - Sigma).norm(), 1e-6 * Sigma.norm());
  }
}

TEST(Ekf, MatchesTheTextbookUpdate) {
  Ekf ekf(setup);
  for (const Step& step : drive(4, 20)) {
    ekf.motion_update(step.odometry);
    ekf.measurement_update(step.scan, ignore);
  }
  const Eigen::VectorXd mu = ekf.mu();
  const Eigen::MatrixXd Sigma = ekf.Sigma();
  RandomDrive random(5);
  const int slots[] = {7, 2, 11};
  Scan scan;
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(6, mu.size());
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(6, 6);
  Eigen::VectorXd v(6);
  for (int i = 0; i < 3; ++i) {
    const int row = 3 + 2 * slots[i];
    scan.observations.push_back(random.observation(ekf.map()[static_cast<std::size_t>(slots[i])].landmark,
                                                   ekf.pose() * setup.T_robot_sensor, mu.segment<2>(row)));
    const PredictedObservation predicted =
        predict_observation(ekf.pose(), setup.T_robot_sensor, mu.segment<2>(row));
    C.block<2, 3>(2 * i, 0) = predicted.J_wrt_pose;
    C.block<2, 2>(2 * i, row) = predicted.J_wrt_landmark;
    Q.block<2, 2>(2 * i, 2 * i) = scan.observations.back().covariance;
    v.segment<2>(2 * i) = innovation(scan.observations.back(), predicted.z);
  }
  const Eigen::MatrixXd K = Sigma * C.transpose() * oracle::inverse(C * Sigma * C.transpose() + Q);
  const Eigen::MatrixXd I_KC = Eigen::MatrixXd::Identity(mu.size(), mu.size()) - K * C;
  ekf.measurement_update(scan, ignore);
  EXPECT_LT((ekf.mu() - (mu + K * v)).norm(), 1e-10);
  EXPECT_LT((ekf.Sigma() - (I_KC * Sigma * I_KC.transpose() + K * Q * K.transpose())).norm(), 1e-12);
}

TEST(Ekf, TakesANewLandmarkThatIsSeenTwiceInOneScan) {
  RandomDrive random(6);
  const Pose2 T_world_sensor = setup.start.mean * setup.T_robot_sensor;
  const Observation first = random.observation(3, T_world_sensor, {2, 3});
  const Observation second = random.observation(3, T_world_sensor, {2, 3});
  Ekf together(setup);
  together.measurement_update({.t = 0, .observations = {first, second}}, ignore);
  Ekf apart(setup);
  apart.measurement_update({.t = 0, .observations = {first}}, ignore);
  apart.measurement_update({.t = 0, .observations = {second}}, ignore);
  EXPECT_EQ(together.mu(), apart.mu());
  EXPECT_EQ(together.Sigma(), apart.Sigma());
}

TEST(SymmetricDowndate, SubtractsTheProductFromTheLowerTriangleOfAnySize) {
  RandomDrive random(9);
  const auto any = [&] { return random.uniform(-1, 1); };
  SymmetricDowndate downdate;
  for (const int n : {1, 3, 8, 23, 24, 43, 100}) {
    for (const int width : {2, 6, 40}) {
      const Eigen::MatrixXd W = Eigen::MatrixXd::NullaryExpr(n, width, any);
      Eigen::MatrixXd Sigma = Eigen::MatrixXd::NullaryExpr(112, 112, any);
      const Eigen::MatrixXd expected = Sigma.topLeftCorner(n, n) - W * W.transpose();
      downdate(Sigma, W);
      const Eigen::MatrixXd difference = Sigma.topLeftCorner(n, n) - expected;
      EXPECT_LT(difference.triangularView<Eigen::Lower>().toDenseMatrix().norm(), 1e-12)
          << n << " x " << width;
    }
  }
}

TEST(Ekf, CountsTheLinksAsTheReportDoes) {
  Ekf ekf(setup);
  RandomDrive random(8);
  Scan scan;
  for (LandmarkId landmark = 0; landmark < 50; ++landmark) {
    scan.observations.push_back(
        random.observation(landmark, setup.start.mean * setup.T_robot_sensor, {landmark * 0.1, 5}));
  }
  ekf.measurement_update(scan, ignore);
  EXPECT_EQ(ekf.counts().links, 1275);
}

}  // namespace
}  // namespace seif
