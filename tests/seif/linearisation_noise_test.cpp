// The noise of the linearisation, against the errors of the linear equation itself.
#include "seif/linearisation_noise.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "seif/models.hpp"

namespace seif {
namespace {

constexpr int samples = 100'000;

/// Mean squares of what the linear equation misses, for a pose that is known and a landmark at a distance of
/// 4 m with an error of covariance C, along and across its direction.
Eigen::Vector2d missed(const Eigen::Matrix2d& C) {
  const Eigen::Vector2d m(4.0, 0.0);
  const PredictedObservation at_mean = predict_observation({}, {}, m);
  const Eigen::Matrix2d L = C.llt().matrixL();
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int k = 0; k < samples; ++k) {
    const double first = normal(random);
    const Eigen::Vector2d error = L * Eigen::Vector2d(first, normal(random));
    const Eigen::Vector2d z = predict_observation({}, {}, m + error).z;
    sum += (z - at_mean.z - at_mean.J_wrt_landmark * error).cwiseAbs2();
  }
  return sum / samples;
}

void expect_near(const Eigen::Vector2d& noise, const Eigen::Vector2d& missed) {
  for (const int i : {0, 1}) EXPECT_NEAR(noise(i), missed(i), 0.1 * missed(i)) << i;
}

TEST(LinearisationNoise, OfANewLandmarkIsWhatTheLinearEquationMisses) {
  Observation z{.landmark = 0, .range = 4.0, .bearing = 0.0, .covariance = Eigen::Matrix2d::Zero()};
  z.covariance.diagonal() << 0.01, 0.0025;
  const Eigen::Vector2d spread(0.01, 16.0 * 0.0025);
  expect_near(linearisation_noise(z, 0.0), missed(spread.asDiagonal()));
}

/// The pose is certain to 1e-6 m and rad, so the window's covariance is that of the landmark.
TEST(LinearisationNoise, OfAKnownLandmarkIsWhatTheLinearEquationMisses) {
  InformationState state({.mean = {}, .covariance = 1e-12 * Eigen::Matrix3d::Identity()});
  const int slot = state.add_landmark(0, {4.0, 0.0});
  state.activate(slot);
  Eigen::Matrix2d C;
  C << 0.02, 0.01, 0.01, 0.05;
  WindowFactor window;
  Eigen::MatrixXd Omega = state.Omega();
  Omega.bottomRightCorner<2, 2>() = C.inverse();
  window.size = Omega.rows();
  window.storage = Omega.llt().matrixL();
  const Observation z{
      .landmark = 0, .range = 4.0, .bearing = 0.0, .covariance = 1e-4 * Eigen::Matrix2d::Identity()};
  const ObservationFactor factor = linearise(state, slot, z, {});
  Eigen::Matrix<double, Eigen::Dynamic, 3> scratch;
  expect_near(linearisation_noise(state, factor, window, scratch), missed(C));
  EXPECT_EQ(heading_variance(window, scratch), 1e-4);
}

TEST(LinearisationNoise, IsGuessedNoSmallerForALandmarkAsUncertainAsItsSighting) {
  InformationState state({.mean = {}, .covariance = 1e-12 * Eigen::Matrix3d::Identity()});
  const int slot = state.add_landmark(0, {4.0, 0.0});
  const Observation z{.landmark = 0,
                      .range = 4.2,
                      .bearing = 0.1,
                      .covariance = Eigen::Vector2d(0.01, 0.0025).asDiagonal().toDenseMatrix()};
  const Eigen::Vector2d rough = rough_linearisation_noise(linearise(state, slot, z, {}), 1e-12);
  const Eigen::Vector2d of_sighting = linearisation_noise(z, 1e-12);
  EXPECT_TRUE((rough.array() >= of_sighting.array()).all()) << rough.transpose();
}

}  // namespace
}  // namespace seif
