// The gate of ekf and seif: which observations it ignores, and that its covariance is the filter's own.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "seif/dense/ekf.hpp"
#include "seif/models.hpp"
#include "seif/seif.hpp"

namespace seif {
namespace {

const StageDone nobody = [](Stage) {};
constexpr int landmark_count = 40;

/// A drive around a circle of 5 m with landmarks on both sides. Those within 4 m are seen.
class Round {
 public:
  explicit Round(unsigned seed) : random_(seed) {}

  Odometry odometry() {
    Odometry u;
    u.t = t_ += 0.2;
    u.T_previous_current = {0.2, 0.0, 0.04};
    u.covariance = Eigen::Vector3d(1e-4, 0.0, 1e-5).asDiagonal();
    pose_ = pose_ * Pose2{0.2 + 0.01 * normal_(random_), 0.0, 0.04 + 0.00316 * normal_(random_)};
    return u;
  }

  const Pose2& truth() const { return pose_; }

  Scan scan() {
    Scan scan;
    scan.t = t_;
    for (int i = 0; i < landmark_count; ++i) {
      const Eigen::Vector2d z = predict_observation(pose_, {}, place(i)).z;
      if (z(0) > 4.0) continue;
      Observation seen{i, z(0) + 0.05 * normal_(random_), wrap_angle(z(1) + 0.01 * normal_(random_)), {}};
      seen.covariance = Eigen::Vector2d(0.0025, 0.0001).asDiagonal();
      scan.observations.push_back(seen);
    }
    return scan;
  }

 private:
  static Eigen::Vector2d place(int i) {
    const double angle = 2.0 * std::numbers::pi * i / landmark_count;
    const double radius = i % 2 == 0 ? 3.5 : 6.5;
    return {radius * std::sin(angle), 5.0 - radius * std::cos(angle)};
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Pose2 pose_;
  double t_ = 0.0;
};

EstimatorSetup setup() {
  EstimatorSetup setup;
  setup.start.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
  return setup;
}

std::unique_ptr<Estimator> make(const std::string& type, double gate, int first_estimates = 5,
                                double robust_above = 0.0) {
  if (type == "ekf")
    return std::make_unique<Ekf>(setup(), EkfOptions{.gate = gate, .robust_above = robust_above});
  SeifOptions options;
  options.gate = gate;
  options.robust_above = robust_above;
  options.first_estimates = first_estimates;
  return std::make_unique<Seif>(setup(), options);
}

class Gate : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Filters, Gate, testing::Values("ekf", "seif"),
                         [](const auto& filter) { return filter.param; });

TEST_P(Gate, LeavesOutWhatIsMisreadAndKeepsTheRest) {
  Round round(1);
  const auto filter = make(GetParam(), 25.0);
  std::int64_t misread = 0;
  for (int step = 0; step < 400; ++step) {
    filter->motion_update(round.odometry());
    Scan scan = round.scan();
    if (step > 200 && step % 10 == 0) {
      scan.observations.front().bearing = wrap_angle(scan.observations.front().bearing + 1.0);
      ++misread;
    }
    filter->measurement_update(scan, nobody);
  }
  EXPECT_EQ(filter->counts().gated, misread);
}

TEST_P(Gate, ChangesNothingWhereNothingIsLeftOut) {
  Round here(2);
  Round there(2);
  const auto with = make(GetParam(), 1e6);
  const auto without = make(GetParam(), 0.0);
  for (int step = 0; step < 300; ++step) {
    with->motion_update(here.odometry());
    without->motion_update(there.odometry());
    with->measurement_update(here.scan(), nobody);
    without->measurement_update(there.scan(), nobody);
    ASSERT_NEAR(with->pose().x, without->pose().x, 1e-9);
    ASSERT_NEAR(with->pose().theta, without->pose().theta, 1e-9);
  }
  EXPECT_EQ(with->counts().gated, 0);
}

/// One observation is changed so that its normalised innovation squared is known, by the covariance that the
/// filter can compute off the live path. The gate must be exactly there. With first estimates the Jacobians of
/// seif are different.
TEST_P(Gate, LiesWhereTheFiltersOwnCovarianceSays) {
  for (const double gate : {0.999, 1.001}) {
    Round round(3);
    const auto probe = make(GetParam(), 0.0, 0);
    std::vector<Odometry> motions;
    std::vector<Scan> scans;
    for (int step = 0; step < 150; ++step) {
      motions.push_back(round.odometry());
      scans.push_back(round.scan());
      probe->motion_update(motions.back());
      if (step < 149) probe->measurement_update(scans.back(), nobody);
    }
    Scan last = scans.back();
    last.observations.resize(1);
    Observation& seen = last.observations.front();
    seen.range += 0.4;
    std::vector<LandmarkEstimate> known;
    const LandmarkIds ids = {seen.landmark};
    probe->landmarks(ids, known);
    ASSERT_EQ(known.size(), 1U);
    const PredictedObservation predicted = predict_observation(probe->pose(), {}, known.front().mean);
    Eigen::Matrix<double, 2, 5> J;
    J << predicted.J_wrt_pose, predicted.J_wrt_landmark;
    const std::vector<LandmarkIds> groups = {ids};
    const Eigen::MatrixXd P = probe->joint_covariances(groups)->front();
    const Eigen::Matrix2d S = J * P * J.transpose() + seen.covariance;
    const Eigen::Vector2d v = innovation(seen, predicted.z);
    const double expected = v.dot(S.inverse() * v);

    const auto filter = make(GetParam(), gate * expected, 0);
    for (int step = 0; step < 149; ++step) {
      filter->motion_update(motions[static_cast<std::size_t>(step)]);
      filter->measurement_update(scans[static_cast<std::size_t>(step)], nobody);
    }
    const std::int64_t before = filter->counts().gated;
    filter->motion_update(motions.back());
    filter->measurement_update(last, nobody);
    EXPECT_EQ(filter->counts().gated - before, gate < 1.0 ? 1 : 0);
  }
}

struct WithOutliers {
  double error = 0.0;      // [m] RMS of the position over the second half
  std::int64_t wrong = 0;  // [-] observations
  std::int64_t right = 0;  // [-]
};

/// A drive in which every tenth scan has a bearing with an error of 0.2.
WithOutliers with_outliers(Estimator& filter) {
  constexpr int steps = 600;
  Round round(4);
  WithOutliers found;
  for (int step = 0; step < steps; ++step) {
    filter.motion_update(round.odometry());
    Scan scan = round.scan();
    found.right += static_cast<std::int64_t>(scan.observations.size());
    if (step % 10 == 9) {
      Observation& seen = scan.observations.front();
      seen.bearing = wrap_angle(seen.bearing + 0.2);
      ++found.wrong;
      --found.right;
    }
    filter.measurement_update(scan, nobody);
    const Pose2 error = inverse(filter.pose()) * round.truth();
    if (2 * step >= steps) found.error += (error.x * error.x + error.y * error.y) / (0.5 * steps);
  }
  found.error = std::sqrt(found.error);
  return found;
}

// Of the right observations, 1.1 % are beyond three sigma: exp(-9/2).
TEST_P(Gate, RobustWeightsWeakenOutliersAndKeepThem) {
  const auto plain = make(GetParam(), 0.0);
  const auto robust = make(GetParam(), 0.0, 5, 3.0);
  const WithOutliers with = with_outliers(*robust);
  EXPECT_LT(with.error, 0.6 * with_outliers(*plain).error);
  EXPECT_EQ(plain->counts().weakened, 0);
  EXPECT_EQ(robust->counts().gated, 0);
  const double by_chance = std::exp(-4.5) * static_cast<double>(with.right);
  EXPECT_NEAR(static_cast<double>(robust->counts().weakened), static_cast<double>(with.wrong) + by_chance,
              4.0 * std::sqrt(by_chance));
}

TEST(RobustWeight, IsOneOverTheDistanceInUnitsOfTheBound) {
  EXPECT_EQ(huber_excess(100.0, 0.0), 1.0);
  EXPECT_EQ(huber_excess(8.99, 3.0), 1.0);
  EXPECT_EQ(huber_excess(36.0, 3.0), 2.0);
}

TEST(GateOfSeif, NeedsTheTree) {
  SeifOptions options;
  options.gate = 9.0;
  options.mean_recovery = MeanRecovery::multilevel;
  EXPECT_THROW(Seif(setup(), options), std::invalid_argument);
  options.gate = 0.0;
  options.robust_above = 3.0;
  EXPECT_THROW(Seif(setup(), options), std::invalid_argument);
}

}  // namespace
}  // namespace seif
