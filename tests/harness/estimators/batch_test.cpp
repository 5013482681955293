#include "harness/estimators/batch.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/score/score.hpp"
#include "seif/models.hpp"

namespace harness {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using seif::Pose2;

const seif::StageDone ignore = [](seif::Stage) {};
const Pose2 T_robot_sensor{0.2, -0.1, 0.3};

/// The motions of a robot that drives around, factors of their noise, and its observations after each motion.
struct Recording {
  seif::PoseEstimate start;
  std::vector<seif::Odometry> motions;
  std::vector<Matrix3d> noise_factors;  // L with L L' = covariance
  std::vector<seif::Scan> scans;
  Pose2 true_pose;  // at the end
  std::vector<Vector2d> true_landmarks;
};

enum class Drive { with_full_rank, differential, with_rests };

Matrix3d noise_factor(Drive drive, int step) {
  Matrix3d L = Matrix3d::Zero();
  if (drive == Drive::with_rests && step % 3 == 1) return L;
  L.leftCols<2>() << 0.02, 0.01, 0.001, -0.002, 0.01, -0.02;
  if (drive == Drive::with_full_rank) L(1, 2) = 0.02;
  return L;
}

/// Eight landmarks on a circle of 4 m, and a robot that drives `steps` steps of 0.5 rad on a circle of 2 m.
/// `noise` scales the drawn noise and the covariances that are reported.
Recording record(Drive drive, int steps, double noise, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Recording recording;
  for (int i = 0; i < 8; ++i)
    recording.true_landmarks.emplace_back(4 * std::cos(0.8 * i), 4 * std::sin(0.8 * i));
  recording.true_pose = {2.0, 0.0, 1.6};
  const Vector3d start_sd = noise * Vector3d(0.05, 0.04, 0.02);
  recording.start.covariance = start_sd.cwiseAbs2().asDiagonal();
  recording.start.mean = {2.0 + start_sd.x() * normal(random), start_sd.y() * normal(random),
                          1.6 + start_sd.z() * normal(random)};
  for (int i = 0; i < steps; ++i) {
    const Matrix3d L = noise * noise_factor(drive, i);
    const Pose2 measured = L.isZero(0.0) ? Pose2{} : Pose2{0.98, 0.24, 0.5};
    const Vector3d w = L * Vector3d(normal(random), normal(random), normal(random));
    recording.true_pose =
        recording.true_pose * Pose2{measured.x + w.x(), measured.y + w.y(), measured.theta + w.z()};
    recording.motions.push_back({i + 1.0, measured, L * L.transpose()});
    recording.noise_factors.push_back(L);
    seif::Scan scan{i + 1.0, {}};
    for (int m = 0; m < 8; ++m) {
      const Vector2d p = inverse(recording.true_pose * T_robot_sensor) *
                         recording.true_landmarks[static_cast<std::size_t>(m)];
      if (p.norm() > 4.0) continue;
      seif::Observation z{m,
                          p.norm() + noise * 0.05 * normal(random),
                          seif::wrap_angle(std::atan2(p.y(), p.x()) + noise * 0.03 * normal(random)),
                          {}};
      z.covariance = noise * noise * Vector2d(0.0025, 0.0009).asDiagonal().toDenseMatrix();
      scan.observations.push_back(z);
    }
    recording.scans.push_back(scan);
  }
  return recording;
}

std::unique_ptr<seif::Estimator> make(const std::string& type, const seif::PoseEstimate& start,
                                      const std::string& guide = "") {
  seif::Options options = test::choice(type).options;
  if (!guide.empty()) options["guide"] = guide;
  return test::test_registry().find(type)->make({start, T_robot_sensor, std::mt19937_64(1)}, options);
}

void feed(const Recording& recording, seif::Estimator& estimator) {
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    estimator.motion_update(recording.motions[i]);
    estimator.measurement_update(recording.scans[i], ignore);
  }
}

std::vector<seif::LandmarkId> ids_of(const seif::Estimator& estimator) {
  std::vector<seif::LandmarkId> ids;
  for (const seif::LandmarkEstimate& landmark : estimator.map()) ids.push_back(landmark.landmark);
  return ids;
}

/// Gauss-Newton on the same problem, dense, with numerical Jacobians and other unknowns: the start, the noise w
/// of each motion (x' = x * (u + L w), exact at any rank of L), and the landmarks.
class DenseOracle {
 public:
  explicit DenseOracle(const Recording& recording)
      : recording_(recording), size_(3 + 3 * static_cast<int>(recording.motions.size()) + 16) {
    x_ = VectorXd::Zero(size_);
    x_.head<3>() << recording.start.mean.x, recording.start.mean.y, recording.start.mean.theta;
    for (int m = 0; m < 8; ++m)
      x_.segment<2>(size_ - 16 + 2 * m) = recording.true_landmarks[static_cast<std::size_t>(m)];
    for (int i = 0; i < 15; ++i)
      x_ -= (J(x_).transpose() * J(x_)).ldlt().solve(J(x_).transpose() * residuals(x_));
    Sigma_ = (J(x_).transpose() * J(x_)).ldlt().solve(Eigen::MatrixXd::Identity(size_, size_));
  }

  Vector3d pose() const { return last_pose(x_); }
  Matrix3d pose_covariance() const {
    const Eigen::MatrixXd G = jacobian([this](const VectorXd& x) -> VectorXd { return last_pose(x); }, x_);
    return G * Sigma_ * G.transpose();
  }
  Eigen::MatrixXd joint_covariance(const std::vector<int>& landmarks) const {
    const auto pose_and_landmarks = [&](const VectorXd& x) -> VectorXd {
      VectorXd all(3 + 2 * static_cast<int>(landmarks.size()));
      all.head<3>() = last_pose(x);
      for (int i = 0; const int m : landmarks) all.segment<2>(3 + 2 * i++) = x.segment<2>(size_ - 16 + 2 * m);
      return all;
    };
    const Eigen::MatrixXd G = jacobian(pose_and_landmarks, x_);
    return G * Sigma_ * G.transpose();
  }
  /// The poses after each motion.
  std::vector<Vector3d> trajectory() const {
    std::vector<Vector3d> poses;
    Vector3d pose = x_.head<3>();
    for (int i = 0; i < static_cast<int>(recording_.motions.size()); ++i)
      poses.push_back(pose = moved(pose, i, x_.segment<3>(3 + 3 * i)));
    return poses;
  }
  Vector2d landmark(int m) const { return x_.segment<2>(size_ - 16 + 2 * m); }
  Matrix2d landmark_covariance(int m) const {
    return Sigma_.block<2, 2>(size_ - 16 + 2 * m, size_ - 16 + 2 * m);
  }

 private:
  /// The heading is not wrapped.
  Vector3d moved(const Vector3d& x, int step, const Vector3d& w) const {
    const auto i = static_cast<std::size_t>(step);
    const Pose2& u = recording_.motions[i].T_previous_current;
    const Vector3d d = Vector3d(u.x, u.y, u.theta) + recording_.noise_factors[i] * w;
    return x + Vector3d(std::cos(x.z()) * d.x() - std::sin(x.z()) * d.y(),
                        std::sin(x.z()) * d.x() + std::cos(x.z()) * d.y(), d.z());
  }

  Vector3d last_pose(const VectorXd& x) const {
    Vector3d pose = x.head<3>();
    for (int i = 0; i < static_cast<int>(recording_.motions.size()); ++i)
      pose = moved(pose, i, x.segment<3>(3 + 3 * i));
    return pose;
  }

  VectorXd residuals(const VectorXd& x) const {
    std::vector<double> all;
    const Pose2& start = recording_.start.mean;
    Vector3d pose = x.head<3>();
    const Vector3d start_error = pose - Vector3d(start.x, start.y, start.theta);
    for (int i = 0; i < 3; ++i) all.push_back(start_error(i) / std::sqrt(recording_.start.covariance(i, i)));
    for (int i = 0; i < static_cast<int>(recording_.motions.size()); ++i) {
      const Vector3d w = x.segment<3>(3 + 3 * i);
      pose = moved(pose, i, w);
      for (int k = 0; k < 3; ++k) all.push_back(w(k));
      const double sensor_heading = pose.z() + T_robot_sensor.theta;
      const Vector2d sensor(
          pose.x() + std::cos(pose.z()) * T_robot_sensor.x - std::sin(pose.z()) * T_robot_sensor.y,
          pose.y() + std::sin(pose.z()) * T_robot_sensor.x + std::cos(pose.z()) * T_robot_sensor.y);
      for (const seif::Observation& z : recording_.scans[static_cast<std::size_t>(i)].observations) {
        const Vector2d d = x.segment<2>(size_ - 16 + 2 * z.landmark) - sensor;
        all.push_back((d.norm() - z.range) / std::sqrt(z.covariance(0, 0)));
        all.push_back(
            std::remainder(std::atan2(d.y(), d.x()) - sensor_heading - z.bearing, 2 * std::numbers::pi) /
            std::sqrt(z.covariance(1, 1)));
      }
    }
    return Eigen::Map<const VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }

  template <class Function>
  static Eigen::MatrixXd jacobian(const Function& f, const VectorXd& at) {
    constexpr double h = 1e-6;
    Eigen::MatrixXd result(f(at).size(), at.size());
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      const VectorXd step = h * VectorXd::Unit(at.size(), i);
      result.col(i) = (f(at + step) - f(at - step)) / (2 * h);
    }
    return result;
  }
  Eigen::MatrixXd J(const VectorXd& x) const {
    return jacobian([this](const VectorXd& y) { return residuals(y); }, x);
  }

  const Recording& recording_;
  int size_;
  VectorXd x_;
  Eigen::MatrixXd Sigma_;
};

class BatchDrives : public testing::TestWithParam<std::tuple<Drive, const char*>> {};

INSTANTIATE_TEST_SUITE_P(All, BatchDrives,
                         testing::Combine(testing::Values(Drive::with_full_rank, Drive::differential,
                                                          Drive::with_rests),
                                          testing::Values("seif", "ekf")));

TEST_P(BatchDrives, IsTheOptimumThatADenseSolverFinds) {
  const auto [drive, guide] = GetParam();
  const Recording recording = record(drive, 14, 1.0, 1);
  const auto batch = make("batch", recording.start, guide);
  feed(recording, *batch);
  const DenseOracle oracle(recording);
  const std::vector<seif::LandmarkEstimate> map = batch->map();
  const auto marginals = batch->marginal_covariances(ids_of(*batch));
  ASSERT_TRUE(marginals);
  ASSERT_EQ(map.size(), 8U);
  for (std::size_t i = 0; i < map.size(); ++i) {
    EXPECT_LT((map[i].mean - oracle.landmark(map[i].landmark)).norm(), 1e-6);
    const Matrix2d expected = oracle.landmark_covariance(map[i].landmark);
    EXPECT_TRUE(marginals->landmarks[i].isApprox(expected, 1e-5)) << marginals->landmarks[i] << '\n'
                                                                  << expected;
  }
  const Vector3d pose = oracle.pose();
  EXPECT_LT(pose_error(batch->pose(), {pose.x(), pose.y(), pose.z()}).norm(), 1e-6);
  EXPECT_TRUE(marginals->pose.isApprox(oracle.pose_covariance(), 1e-5));
}

TEST_P(BatchDrives, KnowsThePoseTogetherWithLandmarks) {
  const auto [drive, guide] = GetParam();
  const Recording recording = record(drive, 14, 1.0, 1);
  const auto batch = make("batch", recording.start, guide);
  feed(recording, *batch);
  EXPECT_FALSE(batch->joint_covariances({})) << "it was not solved for";
  std::vector<seif::LandmarkIds> groups = {ids_of(*batch)};
  for (const seif::LandmarkId id : ids_of(*batch)) groups.push_back({id});
  const auto joint = batch->joint_covariances(groups);
  ASSERT_TRUE(joint);
  const DenseOracle oracle(recording);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Eigen::MatrixXd expected = oracle.joint_covariance(groups[i]);
    EXPECT_TRUE((*joint)[i].isApprox(expected, 1e-5)) << (*joint)[i] << '\n' << expected;
  }
}

TEST_P(BatchDrives, IsNotSolvedForALookAtALandmark) {
  const auto [drive, guide] = GetParam();
  const Recording recording = record(drive, 14, 1.0, 1);
  const auto batch = make("batch", recording.start, guide);
  const auto alone = make(guide, recording.start);
  feed(recording, *batch);
  feed(recording, *alone);
  const std::vector<seif::LandmarkId> one = {alone->map().at(1).landmark};
  std::vector<seif::LandmarkEstimate> seen;
  batch->landmarks(one, seen);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].mean, alone->map().at(1).mean);
  EXPECT_FALSE(batch->joint_covariances({})) << "it was solved for";
  const std::vector<seif::LandmarkEstimate> optimum = batch->map();
  batch->landmarks(one, seen);
  EXPECT_EQ(seen.at(0).mean, std::ranges::find(optimum, one[0], &seif::LandmarkEstimate::landmark)->mean);
}

TEST_P(BatchDrives, TellsOfItsPosesAtAllScans) {
  const auto [drive, guide] = GetParam();
  const Recording recording = record(drive, 14, 1.0, 1);
  const auto batch = make("batch", recording.start, guide);
  feed(recording, *batch);
  const std::vector<Pose2> poses = dynamic_cast<const Batch&>(*batch).trajectory();
  const std::vector<Vector3d> expected = DenseOracle(recording).trajectory();
  ASSERT_EQ(poses.size(), expected.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector3d& pose = expected[i];
    EXPECT_LT(pose_error(poses[i], {pose.x(), pose.y(), pose.z()}).norm(), 1e-6) << "scan " << i;
  }
}

TEST(Batch, IsTheInformationFiltersEstimateWhereAllIsNearlyLinear) {
  const Recording recording = record(Drive::differential, 30, 1e-3, 2);
  const auto batch = make("batch", recording.start);
  const auto eif = make("eif", recording.start);
  feed(recording, *batch);
  feed(recording, *eif);
  const auto map = batch->map();
  const auto expected = eif->map();
  const auto marginals = batch->marginal_covariances(ids_of(*batch));
  const auto expected_marginals = eif->marginal_covariances(ids_of(*eif));
  ASSERT_TRUE(marginals && expected_marginals);
  ASSERT_EQ(map.size(), expected.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    ASSERT_EQ(map[i].landmark, expected[i].landmark);
    EXPECT_LT(nees(map[i].mean - expected[i].mean, marginals->landmarks[i]).value(), 1e-4);  // 0.01 sigma
    EXPECT_TRUE(marginals->landmarks[i].isApprox(expected_marginals->landmarks[i], 1e-2));
  }
  EXPECT_LT(nees(pose_error(batch->pose(), eif->pose()), marginals->pose).value(), 1e-4);
}

TEST(Batch, KnowsHowWrongItIs) {
  constexpr int runs = 40;
  double pose = 0.0;
  double landmark = 0.0;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const Recording recording = record(Drive::differential, 40, 1.0, seed);
    const auto batch = make("batch", recording.start);
    feed(recording, *batch);
    const seif::LandmarkEstimate first = batch->map().front();
    const auto marginals = batch->marginal_covariances(std::vector{first.landmark}).value();
    pose += nees(pose_error(batch->pose(), recording.true_pose), marginals.pose).value() / runs;
    const Vector2d truth = recording.true_landmarks[static_cast<std::size_t>(first.landmark)];
    landmark += nees(first.mean - truth, marginals.landmarks[0]).value() / runs;
  }
  EXPECT_GT(pose, 91.57 / 120);  // chi-square, 120 degrees of freedom, 95 %
  EXPECT_LT(pose, 152.21 / 120);
  EXPECT_GT(landmark, 57.15 / 80);
  EXPECT_LT(landmark, 106.63 / 80);
}

seif::Observation observation(double range, double bearing) {
  return {0, range, bearing, Vector2d(0.0025, 0.0009).asDiagonal()};
}

const seif::PoseEstimate start{{1.0, 2.0, 0.5}, Vector3d(1e-4, 4e-4, 1e-3).asDiagonal()};

/// Expects a landmark, observed in this way from one pose, at the right position with the right covariance.
void expect_landmark(const seif::Estimator& batch, const Pose2& T_world_robot,
                     const Matrix3d& pose_covariance, const seif::Observation& seen) {
  const seif::InverseObservation expected = invert_observation(T_world_robot, T_robot_sensor, seen);
  const Matrix2d covariance =
      expected.J_wrt_pose * pose_covariance * expected.J_wrt_pose.transpose() +
      expected.J_wrt_observation * seen.covariance * expected.J_wrt_observation.transpose();
  ASSERT_EQ(batch.map().size(), 1U);
  EXPECT_LT((batch.map()[0].mean - expected.p_world_landmark).norm(), 1e-9);
  const std::vector<seif::LandmarkId> ids{0};
  EXPECT_TRUE(batch.marginal_covariances(ids)->landmarks[0].isApprox(covariance, 1e-6));
}

TEST(Batch, ARobotAtRestTakesTheMeanOfWhatItSees) {
  const auto batch = make("batch", start);
  for (int i = 0; i < 100; ++i) {
    const double t = i;
    batch->motion_update({t, {}, Matrix3d::Zero()});
    batch->measurement_update({t, {observation(3.0 + 0.1 * (i % 2), 0.4 - 0.02 * (i % 2))}}, ignore);
  }
  seif::Observation mean = observation(3.05, 0.39);
  mean.covariance /= 100;
  expect_landmark(*batch, start.mean, start.covariance, mean);
  EXPECT_TRUE(batch->marginal_covariances({})->pose.isApprox(start.covariance, 1e-9));
}

TEST(Batch, WithoutObservationsItIsDeadReckoning) {
  const auto batch = make("batch", start);
  Pose2 pose = start.mean;
  Matrix3d covariance = start.covariance;
  const Matrix3d L = noise_factor(Drive::differential, 0);
  for (int i = 1; i <= 5; ++i) {
    const seif::Odometry motion{1.0 * i, {0.5, 0.1, 0.3}, L * L.transpose()};
    batch->motion_update(motion);
    if (i < 5) batch->measurement_update({1.0 * i, {}}, ignore);  // no scan follows the last motion
    const seif::PredictedPose predicted = predict_pose(pose, motion);
    pose = predicted.pose;
    covariance = predicted.J_wrt_pose * covariance * predicted.J_wrt_pose.transpose() +
                 predicted.noise_factor * predicted.noise_factor.transpose();
  }
  EXPECT_TRUE(batch->map().empty());
  EXPECT_TRUE(batch->marginal_covariances({})->pose.isApprox(covariance, 1e-6));
  EXPECT_LT(pose_error(batch->pose(), pose).norm(), 1e-9);
}

TEST(Batch, ALandmarkSeenOnceIsWhereItWasSeen) {
  const auto batch = make("batch", start);
  const seif::Odometry motion{1.0, {0.5, 0.1, 0.3}, Vector3d(1e-3, 2e-3, 1e-4).asDiagonal()};
  batch->motion_update(motion);
  batch->measurement_update({1.0, {observation(3.0, 0.4)}}, ignore);
  const seif::PredictedPose predicted = predict_pose(start.mean, motion);
  const Matrix3d covariance = predicted.J_wrt_pose * start.covariance * predicted.J_wrt_pose.transpose() +
                              predicted.noise_factor * predicted.noise_factor.transpose();
  expect_landmark(*batch, predicted.pose, covariance, observation(3.0, 0.4));
}

TEST(Batch, DependsOnTheDataAndNotOnWhenItWasAsked) {
  const Recording recording = record(Drive::differential, 14, 1.0, 3);
  const auto once = make("batch", recording.start);
  const auto often = make("batch", recording.start);
  feed(recording, *once);
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    often->motion_update(recording.motions[i]);
    often->measurement_update(recording.scans[i], ignore);
    EXPECT_FALSE(often->map().empty());
  }
  for (std::size_t i = 0; i < once->map().size(); ++i) EXPECT_EQ(once->map()[i].mean, often->map()[i].mean);
  EXPECT_EQ(pose_error(once->pose(), often->pose()), Vector3d::Zero());
}

TEST(Batch, SaysWhenThereIsNoOptimum) {
  const auto batch = make("batch", start);
  batch->measurement_update({0.0, {observation(std::numeric_limits<double>::infinity(), 0.0)}}, ignore);
  EXPECT_THROW(batch->map(), std::runtime_error);
}

TEST(Compose, CarriesTheCovarianceToFirstOrder) {
  const Matrix3d L = noise_factor(Drive::with_full_rank, 0);
  const seif::Odometry first{1.0, {0.5, 0.1, 0.7}, L * L.transpose()};
  const seif::Odometry second{2.0, {0.3, -0.2, -0.4}, Vector3d(1e-3, 2e-3, 1e-4).asDiagonal()};
  const auto of = [&](const Vector3d& d1, const Vector3d& d2) {
    const Pose2& u1 = first.T_previous_current;
    const Pose2& u2 = second.T_previous_current;
    const Pose2 pose = Pose2{u1.x + d1.x(), u1.y + d1.y(), u1.theta + d1.z()} *
                       Pose2{u2.x + d2.x(), u2.y + d2.y(), u2.theta + d2.z()};
    return Vector3d(pose.x, pose.y, pose.theta);
  };
  constexpr double h = 1e-6;
  Matrix3d J1;
  Matrix3d J2;
  for (int i = 0; i < 3; ++i) {
    const Vector3d step = h * Vector3d::Unit(i);
    J1.col(i) = (of(step, Vector3d::Zero()) - of(-step, Vector3d::Zero())) / (2 * h);
    J2.col(i) = (of(Vector3d::Zero(), step) - of(Vector3d::Zero(), -step)) / (2 * h);
  }
  const seif::Odometry both = compose(first, second);
  const Matrix3d expected = J1 * first.covariance * J1.transpose() + J2 * second.covariance * J2.transpose();
  EXPECT_TRUE(both.covariance.isApprox(expected, 1e-8));
  EXPECT_EQ(both.t, 2.0);
  EXPECT_LT(pose_error(both.T_previous_current, first.T_previous_current * second.T_previous_current).norm(),
            1e-15);
}

/// A robot drives 10 m along the x axis, over a landmark at (5, 0), past two others. The ranges of the first are
/// 6 cm too short before it and too long behind it, so it seems to be at 4.94 m. Where the robot is over it, at
/// 5 m, the measured range is zero, and its bearing says that it is ahead.
FullSlam drive_over_a_landmark() {
  const std::vector<Vector2d> landmarks = {{5.0, 0.0}, {3.0, 4.0}, {7.0, -4.0}};
  FullSlam slam;
  slam.start.covariance = 1e-8 * Matrix3d::Identity();
  slam.landmark_count = 3;
  for (int pose = 0; pose <= 20; ++pose) {
    const double x = 0.5 * pose;
    if (pose > 0) slam.motions.push_back({0.0, {0.5, 0.0, 0.0}, Vector3d(4e-4, 4e-4, 8e-5).asDiagonal()});
    for (int landmark = 0; landmark < 3; ++landmark) {
      const Vector2d away = landmarks[static_cast<std::size_t>(landmark)] - Vector2d(x, 0.0);
      const double error = landmark > 0 || pose == 10 ? 0.0 : (pose < 10 ? -0.06 : 0.06);
      const double bearing = pose == 10 && landmark == 0 ? 0.3 : std::atan2(away.y(), away.x());
      slam.sightings.push_back(
          {pose, landmark, {}, {landmark, away.norm() + error, bearing, Vector2d(0.01, 3e-4).asDiagonal()}});
    }
  }
  return slam;
}

TEST(FullSlamOptimum, IsFoundWhereARobotDrivesOverALandmark) {
  const FullSlam slam = drive_over_a_landmark();
  std::vector<Pose2> poses;
  for (int pose = 0; pose <= 20; ++pose) poses.push_back({0.5 * pose, 0.0, 0.0});
  const std::vector<Vector2d> map = {{5.0, 0.02}, {3.0, 4.0}, {7.0, -4.0}};
  const FullSlamOptimum found = optimum(slam, poses, map);
  EXPECT_NEAR(found.landmarks[0].x(), 4.94, 0.02);
  EXPECT_NEAR(found.landmarks[0].y(), 0.0, 0.05);
  const std::vector<Vector2d> other_map = {{4.8, -0.3}, {3.1, 4.1}, {6.8, -4.0}};
  const FullSlamOptimum again = optimum(slam, poses, other_map);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR((again.landmarks[i] - found.landmarks[i]).norm(), 0.0, 1e-8) << i;
}

}  // namespace
}  // namespace harness
