// What a replay rebuilds, with filters whose beliefs are set by hand.
#include "harness/run/rebuilding.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace harness {
namespace {

/// A filter that believes itself at the origin, with a landmark 2 m ahead, and one 3 m to the left.
class Told final : public seif::Estimator {
 public:
  void motion_update(const seif::Odometry&) override {}
  void measurement_update(const seif::Scan&, const seif::StageDone&) override {}
  seif::Pose2 pose() const override { return {}; }
  seif::Counts counts() const override { return {}; }
  std::size_t memory_bytes() const override { return sizeof *this; }
  std::vector<seif::LandmarkEstimate> map() const override { return {{4, {2.0, 0.0}}, {5, {0.0, 3.0}}}; }
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId>) const override {
    return std::nullopt;
  }
  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const seif::LandmarkIds> groups) const override {
    std::vector<Eigen::MatrixXd> joint;
    for (const seif::LandmarkIds& group : groups) {
      Eigen::VectorXd variances = Eigen::VectorXd::Constant(3 + 2 * static_cast<int>(group.size()), 0.01);
      variances(2) = 0.04;
      joint.emplace_back(variances.asDiagonal());
    }
    return joint;
  }
};

class Rebuilt : public testing::Test {
 protected:
  Rebuilt() {
    believers.estimators.push_back({"told", std::make_unique<Told>(), 1.0, 1.0, {}});
    log.landmarks = {{4, {2.0, 0.3}, 0.1}, {5, {0.1, 3.0}, 0.1}};
  }

  /// With variances of 0.02 m^2 and 0.005 rad^2.
  static seif::Observation observation(seif::LandmarkId landmark, double range, double bearing) {
    return {landmark, range, bearing, Eigen::Vector2d(0.02, 0.005).asDiagonal().toDenseMatrix()};
  }

  static ScanEvent scan(std::vector<seif::Observation> observations) {
    return {{1.0, std::move(observations)}, {}, TruePose{1.0, {}, 0, 0}};
  }

  Believers believers;
  LogDescription log;
};

// z_hat = (2, 0); S = diag(0.01 + 0.01 + 0.02, 0.01 / 4 + 0.04 + 0.01 / 4 + 0.005) = diag(0.04, 0.05).
TEST_F(Rebuilt, NisMatchesTheHandComputedCase) {
  RebuiltConsistency rebuilt(believers, log, 10);
  rebuilt.scored();
  rebuilt.scan(scan({observation(4, 2.2, 0.1)}));
  const RebuiltScore score = rebuilt.scores().at(0);
  EXPECT_EQ(score.observations, 1U);
  EXPECT_NEAR(*score.nis, (0.04 / 0.04 + 0.01 / 0.05) / 2, 1e-12);
  EXPECT_EQ(score.nis_inside, 1.0);
}

TEST_F(Rebuilt, NisBelievesTheNoiseThatTheFilterIsTold) {
  believers.estimators[0].observation_sd_factor = 2.0;
  RebuiltConsistency rebuilt(believers, log, 10);
  rebuilt.scored();
  rebuilt.scan(scan({observation(4, 2.2, 0.1)}));
  EXPECT_NEAR(*rebuilt.scores().at(0).nis, (0.04 / 0.1 + 0.01 / 0.065) / 2, 1e-12);
}

TEST_F(Rebuilt, NisIsOfTheScanAfterAScoringTimeAndOfKnownLandmarks) {
  RebuiltConsistency rebuilt(believers, log, 10);
  rebuilt.scan(scan({observation(4, 9.0, 0.0)}));
  EXPECT_FALSE(rebuilt.scores().at(0).nis) << "no scoring time yet";
  rebuilt.scored();
  rebuilt.scan(scan({observation(7, 1.0, 0.0), observation(4, 2.0, 0.0), observation(8, 1.0, 0.0),
                     observation(4, 2.2, 0.1), observation(4, 4.0, 0.0)}));
  rebuilt.scan(scan({observation(4, 9.0, 0.0)}));
  const RebuiltScore score = rebuilt.scores().at(0);
  EXPECT_EQ(score.observations, 3U);
  EXPECT_NEAR(*score.nis, (0.0 + 0.6 + 50.0) / 3, 1e-12);
  EXPECT_NEAR(*score.nis_inside, 1.0 / 3, 1e-12) << "the band is 0.025 to 3.69";
}

// Landmarks 4 and 5 are seen 0.2 m too far, and at bearings 0.1 rad and 0 larger than expected. In S the ranges
// have variances of 0.04 and covariance 0 (they point along x and y). The bearing of landmark 4 changes by
// -theta - y / 2 + m_y / 2, that of landmark 5 by -theta + x / 3 - m_x / 3: variances 0.05 and 0.04 + 0.02 / 9
// + 0.005, covariance 0.04. Range 4 and bearing 5: -x of the robot and x / 3, so -0.01 / 3. Range 5 and bearing
// 4: -y and -y / 2, so 0.005.
TEST_F(Rebuilt, NisOfAScanMatchesTheHandComputedCase) {
  RebuiltConsistency rebuilt(believers, log, 10);
  rebuilt.scored();
  rebuilt.scan(scan({observation(4, 2.2, 0.1), observation(5, 3.2, std::numbers::pi / 2)}));
  Eigen::Matrix4d S;               // range 4, bearing 4, range 5, bearing 5
  S << 0.04, 0.0, 0.0, -0.01 / 3,  //
      0.0, 0.05, 0.005, 0.04,      //
      0.0, 0.005, 0.04, 0.0,       //
      -0.01 / 3, 0.04, 0.0, 0.045 + 0.02 / 9;
  const Eigen::Vector4d nu(0.2, 0.1, 0.2, 0.0);
  const ScanNisScore scans = rebuilt.scores().at(0).scans;
  EXPECT_EQ(scans.count, 1U);
  EXPECT_NEAR(*scans.nis, nu.dot(S.inverse() * nu) / 4, 1e-12);
  EXPECT_EQ(scans.inside, 1.0);
}

TEST_F(Rebuilt, NisIsNotOfAFilterThatHasFailed) {
  believers.estimators[0].failure = "at 0 s";
  RebuiltConsistency rebuilt(believers, log, 10);
  rebuilt.scored();
  rebuilt.scan(scan({observation(4, 2.2, 0.1)}));
  EXPECT_FALSE(rebuilt.scores().at(0).nis);
}

// Variances as seen from the robot: landmark 4 has diag(0.02, 0.02 + 4 * 0.04) and the error (0, -0.3);
// landmark 5 has diag(0.02 + 9 * 0.04, 0.02) and the error (-0.1, 0).
TEST_F(Rebuilt, NeesFromRobotMatchesTheHandComputedCase) {
  RebuiltConsistency rebuilt(believers, log, 10);
  rebuilt.odometry({{}, TruePose{}});
  rebuilt.consistency(0, {});
  const double first = (0.09 / 0.18 / 2 + 0.01 / 0.38 / 2) / 2;
  EXPECT_NEAR(*rebuilt.scores().at(0).nees_landmark_from_robot, first, 1e-12);
  EXPECT_EQ(rebuilt.scores().at(0).landmarks_from_robot_inside, 0.5) << "the second is below 0.025";
  // The robot is 0.6 m to the left of its believed position: errors (0, 0.3) and (-0.1, 0.6).
  rebuilt.odometry({{}, TruePose{0, {0.0, 0.6, 0.0}, 0, 0}});
  rebuilt.consistency(0, {});
  const double second = (0.09 / 0.18 / 2 + (0.01 / 0.38 + 0.36 / 0.02) / 2) / 2;
  EXPECT_NEAR(*rebuilt.scores().at(0).nees_landmark_from_robot, (first + second) / 2, 1e-12);
  EXPECT_NEAR(*rebuilt.scores().at(0).nees_landmark_from_robot_final, second, 1e-12);
}

TEST_F(Rebuilt, NeesFromRobotTakesASampleOfTheMap) {
  RebuiltConsistency rebuilt(believers, log, 1);
  rebuilt.odometry({{}, TruePose{}});
  rebuilt.consistency(0, {});
  EXPECT_NEAR(*rebuilt.scores().at(0).nees_landmark_from_robot, 0.09 / 0.18 / 2, 1e-12);
}

TEST_F(Rebuilt, WithoutTruthThereIsNoNees) {
  RebuiltConsistency rebuilt(believers, log, 10);
  rebuilt.consistency(0, {});
  EXPECT_FALSE(rebuilt.scores().at(0).nees_landmark_from_robot);
  log.landmarks.reset();
  rebuilt.odometry({{}, TruePose{}});
  rebuilt.consistency(0, {});
  EXPECT_FALSE(rebuilt.scores().at(0).nees_landmark_from_robot);
}

}  // namespace
}  // namespace harness
