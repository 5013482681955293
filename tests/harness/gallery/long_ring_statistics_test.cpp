// Rings so long that the EKF fails when they close, against the optimum of the same measurements.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "harness/estimators/batch.hpp"
#include "harness/statistics/alignment.hpp"
#include "seif/dense/ekf.hpp"
#include "seif/models.hpp"
#include "seif/ring_drive.hpp"
#include "seif/seif.hpp"

namespace harness {
namespace {

using Eigen::Vector2d;
using seif::Pose2;

const seif::StageDone ignore = [](seif::Stage) {};

/// NEES per degree of freedom. [-]
struct Nees {
  double pose;
  double map;
};

/// A drive along a ring in steps of 0.5 m, with one landmark per 1.25 m of the ring, within 3 m of it on both
/// sides. Those within 4 m of the robot are seen.
class Ring {
 public:
  Ring(double length, unsigned seed) : length_(length), radius_(length / (2 * std::numbers::pi)) {
    random_.seed(seed);
    std::uniform_real_distribution<double> along(0.0, 2 * std::numbers::pi);
    std::uniform_real_distribution<double> beside(-3.0, 3.0);
    for (int i = 0; i < static_cast<int>(length / 1.25); ++i) {
      const double angle = along(random_);
      landmarks_.push_back((radius_ + beside(random_)) * Vector2d(std::cos(angle), std::sin(angle)));
    }
    start_ = {.mean = {radius_ + 0.01 * normal_(random_), 0.01 * normal_(random_),
                       std::numbers::pi / 2 + 0.01 * normal_(random_)},
              .covariance = 1e-4 * Eigen::Matrix3d::Identity()};
  }

  seif::EstimatorSetup setup() const {
    return {.start = start_, .T_robot_sensor = {}, .random = std::mt19937_64(5)};
  }

  /// Repeats the whole drive for each filter with the same random numbers. Calls after_step(k) after each step.
  template <class AfterStep>
  void drive(seif::Estimator& filter, int steps, AfterStep&& after_step) {
    const std::mt19937_64 random = random_;
    normal_.reset();
    for (int k = 1; k <= steps; ++k) {
      filter.motion_update(odometry(k));
      filter.measurement_update(scan(k), ignore);
      after_step(k);
    }
    random_ = random;
  }
  void drive(seif::Estimator& filter) {
    drive(filter, static_cast<int>(1.1 * length_ / 0.5), [](int) {});
  }

  /// The first step that sees landmarks of the beginning again.
  int closing_step() const {
    int step = static_cast<int>(0.5 * length_ / 0.5);
    while (!std::ranges::any_of(landmarks_, [&](const Vector2d& m) { return sees(1, m) && sees(step, m); })) {
      ++step;
    }
    return step;
  }

  /// The NEES of the pose after this step, and its mean over the map.
  Nees nees(const seif::Estimator& filter, int step) const {
    std::vector<seif::LandmarkId> ids;
    std::vector<Vector2d> errors;
    for (const seif::LandmarkEstimate& landmark : filter.map()) {
      ids.push_back(landmark.landmark);
      errors.push_back(landmark.mean - landmarks_.at(static_cast<std::size_t>(landmark.landmark)));
    }
    const seif::MarginalCovariances covariances = filter.marginal_covariances(ids).value();
    const Pose2 is = truth(step);
    const Pose2 believed = filter.pose();
    const Eigen::Vector3d error(believed.x - is.x, believed.y - is.y,
                                seif::wrap_angle(believed.theta - is.theta));
    Nees nees{.pose = error.dot(covariances.pose.inverse() * error) / 3, .map = 0.0};
    for (std::size_t i = 0; i < ids.size(); ++i) {
      nees.map += errors[i].dot(covariances.landmarks[i].inverse() * errors[i]) / 2;
    }
    nees.map /= static_cast<double>(ids.size());
    return nees;
  }

  /// RMSE of the map after its best rigid motion [m].
  double aligned_error(const seif::Estimator& filter) const {
    std::vector<Vector2d> estimates;
    std::vector<Vector2d> truth;
    for (const seif::LandmarkEstimate& landmark : filter.map()) {
      estimates.push_back(landmark.mean);
      truth.push_back(landmarks_.at(static_cast<std::size_t>(landmark.landmark)));
    }
    const std::optional<Pose2> T = align(estimates, truth);
    double squares = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) squares += (*T * estimates[i] - truth[i]).squaredNorm();
    return std::sqrt(squares / static_cast<double>(truth.size()));
  }

 private:
  Pose2 truth(int step) const {
    const double angle = step * 0.5 / radius_;
    return {radius_ * std::cos(angle), radius_ * std::sin(angle),
            seif::wrap_angle(angle + std::numbers::pi / 2)};
  }

  bool sees(int step, const Vector2d& p_world_landmark) const {
    const Pose2 T = truth(step);
    return (p_world_landmark - Vector2d(T.x, T.y)).norm() <= 4.0;
  }

  seif::Odometry odometry(int step) {
    const Eigen::Vector3d sd(2e-3, 2e-4, 6.3e-4);
    seif::Odometry u{.t = step * 1.0, .T_previous_current = inverse(truth(step - 1)) * truth(step)};
    u.covariance = sd.cwiseAbs2().asDiagonal();
    u.T_previous_current.x += sd.x() * normal_(random_);
    u.T_previous_current.y += sd.y() * normal_(random_);
    u.T_previous_current.theta += sd.z() * normal_(random_);
    return u;
  }

  seif::Scan scan(int step) {
    constexpr double range_sd = 0.004;
    constexpr double bearing_sd = 0.002;
    seif::Scan scan{.t = step * 1.0, .observations = {}};
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      if (!sees(step, landmarks_[i])) continue;
      const Vector2d p = inverse(truth(step)) * landmarks_[i];
      seif::Observation z{.landmark = static_cast<seif::LandmarkId>(i)};
      z.range = p.norm() + range_sd * normal_(random_);
      z.bearing = seif::wrap_angle(std::atan2(p.y(), p.x()) + bearing_sd * normal_(random_));
      z.covariance = Vector2d(range_sd * range_sd, bearing_sd * bearing_sd).asDiagonal();
      scan.observations.push_back(z);
    }
    return scan;
  }

  double length_;
  double radius_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::vector<Vector2d> landmarks_;
  seif::PoseEstimate start_;
};

/// Ratios of the errors of seif to those of the optimum, sorted.
std::vector<double> ratios(double length, int rings) {
  std::vector<double> ratios;
  for (int seed = 1; seed <= rings; ++seed) {
    Ring ring(length, static_cast<unsigned>(seed));
    seif::Seif seif(ring.setup(), {});
    ring.drive(seif);
    Batch batch(ring.setup(), std::make_unique<seif::Seif>(ring.setup(), seif::SeifOptions{}));
    ring.drive(batch);
    ratios.push_back(ring.aligned_error(seif) / ring.aligned_error(batch));
    std::printf("seed %d: %.3f m, optimum %.3f m\n", seed, ring.aligned_error(seif),
                ring.aligned_error(batch));
  }
  std::ranges::sort(ratios);
  return ratios;
}

TEST(LongRing, OfTwoKilometresClosesNearlyAsInTheOptimum) {
  const std::vector<double> found = ratios(2000.0, 5);
  EXPECT_LE(found.at(2), 1.3);
  EXPECT_LE(found.back(), 2.0);
}

// The aim for the worst is 1.2; measured are 1.01 and 1.35.
TEST(LongRing, OfFiveHundredMetresClosesAsInTheOptimum) {
  const std::vector<double> found = ratios(500.0, 21);
  EXPECT_LE(found.at(10), 1.05);
  EXPECT_LE(found.back(), 2.0);
}

/// In the last update before the ring closes, in the update that closes it, and 400 updates later.
using AboutClosure = std::array<Nees, 3>;

AboutClosure nees_about_closure(Ring& ring, seif::Estimator& filter) {
  const int closing = ring.closing_step();
  const std::array steps{closing - 1, closing, closing + 400};
  AboutClosure found{};
  ring.drive(filter, steps.back(), [&](int step) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (step == steps[i]) found[i] = ring.nees(filter, step);
    }
  });
  return found;
}

AboutClosure mean_of(const std::vector<AboutClosure>& rings) {
  AboutClosure mean{};
  for (const AboutClosure& ring : rings) {
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i].pose += ring[i].pose / static_cast<double>(rings.size());
      mean[i].map += ring[i].map / static_cast<double>(rings.size());
    }
  }
  return mean;
}

void print(const char* filter, const AboutClosure& nees) {
  std::printf("%-5s NEES of pose, map: before %.2f, %.2f; at %.2f, %.2f; after %.2f, %.2f\n", filter,
              nees[0].pose, nees[0].map, nees[1].pose, nees[1].map, nees[2].pose, nees[2].map);
}

TEST(LongRing, KnowsHowFarOffItIsBeforeItClosesAndAfter) {
  std::vector<AboutClosure> of_seif;
  std::vector<AboutClosure> of_ekf;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Ring ring(500.0, seed);
    seif::Seif seif(ring.setup(), {});
    of_seif.push_back(nees_about_closure(ring, seif));
    print("seif", of_seif.back());
    seif::Ekf ekf(ring.setup());
    of_ekf.push_back(nees_about_closure(ring, ekf));
    print("ekf", of_ekf.back());
  }
  const AboutClosure seif = mean_of(of_seif);
  const AboutClosure ekf = mean_of(of_ekf);
  std::printf("Means\n");
  print("seif", seif);
  print("ekf", ekf);
  for (const Nees& nees : seif) {
    EXPECT_GE(nees.pose, 0.8);
    EXPECT_LE(nees.pose, 1.3);
    EXPECT_GE(nees.map, 0.8);
    EXPECT_LE(nees.map, 1.3);
  }
  EXPECT_GT(std::min(ekf[2].pose, ekf[2].map), 100.0);  // the task is not easy
}

/// Driven twice, nearly to the end: 3.7 km and 15 km.
TEST(LongRing, OfManyKilometresKnowsWhereTheRobotIs) {
  std::vector<double> nees;
  for (const int landmarks : {5'000, 20'000}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      seif::test::RingDrive drive(landmarks, seed);
      seif::Seif seif(drive.setup(), {});
      const int round = drive.steps_for_a_round();
      for (int k = 0; k < round - 20; ++k) drive.step(seif);
      const double off_where_it_closes = drive.error_of(seif.pose()).head<2>().norm();
      for (int k = 0; k < round; ++k) drive.step(seif);
      const Eigen::Vector3d error = drive.error_of(seif.pose());
      nees.push_back(error.dot(seif.pose_covariance().value().inverse() * error) / 3);
      std::printf("%d landmarks, seed %u: %.0f m off where it closes, NEES of the pose at the end %.2f\n",
                  landmarks, seed, off_where_it_closes, nees.back());
    }
  }
  const double mean = std::accumulate(nees.begin(), nees.end(), 0.0) / static_cast<double>(nees.size());
  EXPECT_LT(mean, 3.0);  // 1.2; before parts turned, 744
}

}  // namespace
}  // namespace harness
