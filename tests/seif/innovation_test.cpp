// The innovation of a scan as the filters compute it, against its definition from their own covariance.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <memory>
#include <string>
#include <vector>

#include "path_drive.hpp"
#include "seif/dense/ekf.hpp"
#include "seif/models.hpp"
#include "seif/seif.hpp"

namespace seif {
namespace {

const StageDone no_listener = [](Stage) {};

struct Innovation {
  double squared = 0.0;  // v' S^-1 v
  int degrees = 0;
};

/// v' (H P H' + Q)^-1 v of the landmarks that are in the map.
Innovation by_definition(const Estimator& filter, const Scan& scan) {
  LandmarkIds ids;
  for (const Observation& z : scan.observations) ids.push_back(z.landmark);
  std::vector<LandmarkEstimate> known;
  filter.landmarks(ids, known);
  if (known.empty()) return {};
  ids.clear();
  for (const LandmarkEstimate& landmark : known) ids.push_back(landmark.landmark);
  const Eigen::MatrixXd P = filter.joint_covariances({&ids, 1})->front();
  const auto size = 2 * static_cast<Eigen::Index>(known.size());
  Eigen::VectorXd v(size);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, 3 + size);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(size, size);
  std::size_t i = 0;
  for (const Observation& z : scan.observations) {
    if (i == known.size() || known[i].landmark != z.landmark) continue;
    const PredictedObservation predicted = predict_observation(filter.pose(), {}, known[i].mean);
    const auto row = 2 * static_cast<Eigen::Index>(i++);
    v.segment<2>(row) = innovation(z, predicted.z);
    H.block<2, 3>(row, 0) = predicted.J_wrt_pose;
    H.block<2, 2>(row, 3 + row) = predicted.J_wrt_landmark;
    S.block<2, 2>(row, row) = z.covariance;
  }
  S += H * P * H.transpose();
  return {v.dot(S.llt().solve(v)), static_cast<int>(size)};
}

test::PathDrive drive() {
  test::Points landmarks;
  for (int i = 0; i < 24; ++i) landmarks.emplace_back(2.0 * (i % 6), 3.0 * (i / 6));
  return {landmarks, {{0, 1.5}, {10, 1.5}, {10, 7.5}, {0, 7.5}, {0, 1.5}, {10, 1.5}}, 4};
}

std::unique_ptr<Estimator> make(const std::string& type, const EstimatorSetup& setup) {
  if (type == "ekf") return std::make_unique<Ekf>(setup);
  SeifOptions options;
  options.first_estimates = 0;  // Jacobians at the mean, as in the definition
  options.closing_gate = 0.0;
  options.linearisation_noise = 0.0;
  options.theta_max = 100;  // no sparsification, which would change the belief
  return std::make_unique<Seif>(setup, options);
}

class InnovationOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Filters, InnovationOf, testing::Values("ekf", "seif"),
                         [](const auto& filter) { return filter.param; });

TEST_P(InnovationOf, AScanIsThatOfItsDefinition) {
  test::PathDrive path = drive();
  const auto filter = make(GetParam(), path.setup());
  double sum = 0.0;
  int degrees = 0;
  while (!path.at_end()) {
    path.advance();
    filter->motion_update(path.odometry());
    const Innovation expected = by_definition(*filter, path.scan());
    filter->measurement_update(path.scan(), no_listener);
    const Counts counts = filter->counts();
    ASSERT_TRUE(counts.innovation);
    ASSERT_EQ(counts.innovation_degrees, expected.degrees);
    EXPECT_NEAR(*counts.innovation, expected.squared, 1e-5 * (1.0 + expected.squared)) << path.odometry().t;
    sum += *counts.innovation;
    degrees += counts.innovation_degrees;
  }
  ASSERT_GT(degrees, 300);
  EXPECT_NEAR(sum / degrees, 1.0, 0.25);
}

// The innovation of one scan is not reported again for the next scan.
TEST_P(InnovationOf, AScanWithoutKnownLandmarksIsZero) {
  test::PathDrive path = drive();
  const auto filter = make(GetParam(), path.setup());
  for (int i = 0; i < 5; ++i) {
    path.advance();
    filter->motion_update(path.odometry());
    filter->measurement_update(path.scan(), no_listener);
  }
  EXPECT_GT(*filter->counts().innovation, 0.0);
  filter->measurement_update({path.odometry().t, {}}, no_listener);
  EXPECT_EQ(filter->counts().innovation, 0.0);
  EXPECT_EQ(filter->counts().innovation_degrees, 0);
}

}  // namespace
}  // namespace seif
