// An observation's factor: what it adds to the information form, how it is taken out again, and where it is
// linearised.
#include "seif/observation_factor.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "driven_state.hpp"
#include "seif/full_state.hpp"

namespace seif {
namespace {

using oracle::DenseBelief;
using oracle::RandomDrive;
using test::relative;
using test::start;
using test::T_robot_sensor;

constexpr double factor_rounding = 1e-11;  // relative

class ObservationFactors : public testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override {
    test::drive(state, random, 25);
    const Pose2 T_world_sensor = state.pose() * T_robot_sensor;
    for (int slot = 0; slot < state.landmark_count(); slot += 2) {  // active ones and passive ones
      scan.push_back(random.observation(state.id(slot), T_world_sensor, state.mean(slot)));
      scan.back().bearing = wrap_angle(scan.back().bearing + 0.3);  // no innovation is near zero
    }
  }

  int slot_of(const Observation& z) const { return state.find(z.landmark).value(); }

  std::vector<ObservationFactor> factors() const {
    std::vector<ObservationFactor> factors;
    for (const Observation& z : scan) factors.push_back(linearise(state, slot_of(z), z, T_robot_sensor));
    return factors;
  }

  void move_the_mean() {
    state.move_robot({0.1, -0.2, 0.05});
    for (int slot = 0; slot < state.landmark_count(); ++slot) state.move_landmark(slot, {0.01 * slot, -0.3});
  }

  RandomDrive random{GetParam()};
  InformationState state{start};
  std::vector<Observation> scan;
};

INSTANTIATE_TEST_SUITE_P(Seeds, ObservationFactors, testing::Values(1U, 2U, 3U));

TEST_P(ObservationFactors, WhatIsAddedCanBeTakenOutAgain) {
  const Eigen::MatrixXd Omega = oracle::symmetric(full_Omega(state));
  const Eigen::VectorXd r = full_r(state);
  const std::vector<ObservationFactor> all = factors();
  for (const ObservationFactor& factor : all) add(state, factor);
  EXPECT_GT(relative(oracle::symmetric(full_Omega(state)), Omega), 1e-3);
  for (const ObservationFactor& factor : all) subtract(state, factor);
  EXPECT_LT(relative(oracle::symmetric(full_Omega(state)), Omega), factor_rounding);
  EXPECT_LT(relative(full_r(state), r), factor_rounding);
}

TEST_P(ObservationFactors, AlsoWhenTheMeanHasMovedBetween) {
  const DenseBelief before = oracle::dense(state);
  const std::vector<ObservationFactor> all = factors();
  for (const ObservationFactor& factor : all) add(state, factor);
  move_the_mean();
  for (const ObservationFactor& factor : all) subtract(state, factor);
  EXPECT_GT((full_mu(state) - before.mu).norm(), 1.0);
  EXPECT_LT(relative(oracle::symmetric(full_Omega(state)), before.H), factor_rounding);
  const Eigen::VectorXd r = before.b - before.H * full_mu(state);  // without the factors, at this mean
  EXPECT_LT(relative(full_r(state), r), factor_rounding);
}

TEST_P(ObservationFactors, EqualTheDenseMeasurementUpdate) {
  DenseBelief belief = oracle::dense(state);
  for (const ObservationFactor& factor : factors()) add(state, factor);
  for (const Observation& z : scan) oracle::measurement_update(belief, slot_of(z), z, T_robot_sensor);
  const DenseBelief now = oracle::dense(state);
  EXPECT_LT(relative(now.H, belief.H), factor_rounding);
  EXPECT_LT(relative(now.b, belief.b), factor_rounding);
  for (const Observation& z : scan) EXPECT_GE(state.position(slot_of(z)), 0);
}

TEST_P(ObservationFactors, RelinearisedEqualOnesThatWereLinearisedThereFromTheStart) {
  const std::vector<ObservationFactor> first = factors();
  for (const ObservationFactor& factor : first) add(state, factor);
  move_the_mean();
  const std::vector<ObservationFactor> second = factors();
  for (const ObservationFactor& factor : first) subtract(state, factor);
  for (const ObservationFactor& factor : second) add(state, factor);

  InformationState from_start(start);
  RandomDrive same(GetParam());
  test::drive(from_start, same, 25);
  from_start.move_robot({0.1, -0.2, 0.05});
  for (int slot = 0; slot < state.landmark_count(); ++slot) {
    from_start.move_landmark(slot, {0.01 * slot, -0.3});
  }
  for (const Observation& z : scan) add(from_start, linearise(from_start, slot_of(z), z, T_robot_sensor));
  EXPECT_LT(relative(oracle::symmetric(full_Omega(state)), oracle::symmetric(full_Omega(from_start))),
            factor_rounding);
  EXPECT_LT(relative(full_r(state), full_r(from_start)), factor_rounding);
}

TEST_P(ObservationFactors, TheResidualIsTheInnovationThatALinearSensorWouldHave) {
  const std::vector<ObservationFactor> all = factors();
  move_the_mean();
  for (const ObservationFactor& factor : all) {
    const Eigen::Vector3d dx(0.1, -0.2, 0.05);
    const Eigen::Vector2d dm(0.01 * factor.slot, -0.3);
    const Eigen::Vector2d expected = factor.v - factor.J_x * dx - factor.J_m * dm;
    EXPECT_LT((residual(state, factor) - expected).norm(), 1e-12);
  }
}

/// u along heading + bearing, n across: v = (z_r - u.(m - s), -n.(m - s) / z_r), with s the sensor's place.
TEST_P(ObservationFactors, AtTheMeasurementFollowTheFormulasOfTheLineOfSight) {
  state.move_robot({1.0, -2.0, 0.8});  // the pose is wrong, so the innovations are large
  const Pose2 x = state.pose();
  const Pose2 T_world_sensor = x * T_robot_sensor;
  const Eigen::Vector2d s(T_world_sensor.x, T_world_sensor.y);
  const Eigen::Vector2d lever = s - Eigen::Vector2d(x.x, x.y);
  for (const Observation& z : scan) {
    const ObservationFactor factor = linearise_at_measurement(state, slot_of(z), z, T_robot_sensor);
    const double angle = T_world_sensor.theta + z.bearing;
    const Eigen::Vector2d u(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d n(-std::sin(angle), std::cos(angle));
    const Eigen::Vector2d across_lever(-lever.y(), lever.x());
    Eigen::Matrix2d J_m;
    J_m << u.transpose(), n.transpose() / z.range;
    Matrix23 J_x;
    J_x << -u.transpose(), -u.dot(across_lever), -n.transpose() / z.range,
        -n.dot(across_lever) / z.range - 1.0;
    const Eigen::Vector2d to_landmark = state.mean(slot_of(z)) - s;
    const Eigen::Vector2d v(z.range - u.dot(to_landmark), -n.dot(to_landmark) / z.range);
    EXPECT_LT((factor.J_m - J_m).norm(), 1e-12);
    EXPECT_LT((factor.J_x - J_x).norm(), 1e-12);
    EXPECT_LT((factor.v - v).norm(), 1e-12);
    EXPECT_GT(v.norm(), 0.1);
  }
}

TEST_P(ObservationFactors, AtTheMeasurementHaveTheSlopeOfTheSensorThere) {
  const double step = 1e-6;  // central differences: an error of 1e-12 / range^3
  for (const Observation& z : scan) {
    const ObservationFactor factor = linearise_at_measurement(state, slot_of(z), z, T_robot_sensor);
    const Pose2 x = state.pose();
    const Eigen::Vector2d seen_at =
        x * T_robot_sensor * Eigen::Vector2d(z.range * std::cos(z.bearing), z.range * std::sin(z.bearing));
    const auto slope = [&](const Eigen::Vector3d& dx, const Eigen::Vector2d& dm) {
      const auto h = [&](double sign) {
        const Pose2 moved{x.x + sign * dx.x(), x.y + sign * dx.y(), x.theta + sign * dx.z()};
        return predict_observation(moved, T_robot_sensor, seen_at + sign * dm).z;
      };
      Eigen::Vector2d difference = h(step) - h(-step);
      difference(1) = wrap_angle(difference(1));
      return Eigen::Vector2d(difference / (2 * step));
    };
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d numeric = slope(Eigen::Vector3d::Unit(k), Eigen::Vector2d::Zero());
      EXPECT_LT((factor.J_x.col(k) - numeric).norm(), 1e-7);
    }
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d numeric = slope(Eigen::Vector3d::Zero(), Eigen::Vector2d::Unit(k));
      EXPECT_LT((factor.J_m.col(k) - numeric).norm(), 1e-7);
    }
  }
}

}  // namespace
}  // namespace seif
