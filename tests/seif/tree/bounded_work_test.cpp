// The work of each single update, however the robot drives through a map that it knows.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "seif/models.hpp"
#include "seif/ring_drive.hpp"
#include "seif/seif.hpp"

namespace seif {
namespace {

/// A square field with a landmark about every two metres. The robot sees up to 5 m.
class FieldDrive {
 public:
  static constexpr double side = test::under_sanitizer ? 24.0 : 60.0;  // [m]

  explicit FieldDrive(unsigned seed) : random_(seed) {
    std::uniform_real_distribution<double> jitter(-0.6, 0.6);
    for (int i = 0; i < per_side * per_side; ++i)
      landmarks_.emplace_back(2.0 * (i % per_side) + jitter(random_), 2.0 * (i / per_side) + jitter(random_));
  }

  EstimatorSetup setup() const {
    return {.start = {.mean = truth_, .covariance = 1e-8 * Eigen::Matrix3d::Identity()},
            .T_robot_sensor = {},
            .random = std::mt19937_64(5)};
  }

  /// Drives to a pose in one step, and looks. Returns the blocks that this update touched.
  std::int64_t step_to(Seif& filter, const Pose2& pose) {
    const std::int64_t before = filter.counts().blocks_touched;
    const double distance = std::hypot(pose.x - truth_.x, pose.y - truth_.y);
    Odometry odometry{.t = ++t_, .T_previous_current = inverse(truth_) * pose};
    odometry.covariance.diagonal() << 1e-4 + 1e-4 * distance, 1e-6 + 1e-4 * distance, 1e-5;
    odometry.T_previous_current.x += std::sqrt(odometry.covariance(0, 0)) * noise_(random_);
    odometry.T_previous_current.y += std::sqrt(odometry.covariance(1, 1)) * noise_(random_);
    odometry.T_previous_current.theta += std::sqrt(odometry.covariance(2, 2)) * noise_(random_);
    truth_ = pose;
    filter.motion_update(odometry);
    filter.measurement_update(look(), test::ignore);
    return filter.counts().blocks_touched - before;
  }

  /// Along its heading.
  std::int64_t go(Seif& filter, double distance) {
    return step_to(filter, truth_ * Pose2{distance, 0.0, 0.0});
  }
  /// Drives and turns towards a place, by up to `longest` [m]. Turns in place first where it is not ahead.
  std::int64_t go_towards(Seif& filter, const Eigen::Vector2d& place, double longest) {
    const Eigen::Vector2d to_go = place - Eigen::Vector2d(truth_.x, truth_.y);
    const double turn = wrap_angle(std::atan2(to_go.y(), to_go.x()) - truth_.theta);
    if (std::abs(turn) > 0.3) return step_to(filter, truth_ * Pose2{0.0, 0.0, std::copysign(0.3, turn)});
    return step_to(filter, truth_ * Pose2{0.0, 0.0, turn} * Pose2{std::min(longest, to_go.norm()), 0.0, 0.0});
  }
  /// From one place to another, anywhere.
  std::int64_t wander(Seif& filter, double longest) {
    if (is_at(goal_)) goal_ = anywhere();
    return go_towards(filter, goal_, longest);
  }
  bool is_at(const Eigen::Vector2d& place) const {
    return (place - Eigen::Vector2d(truth_.x, truth_.y)).norm() < 1e-6;
  }
  const Pose2& truth() const { return truth_; }

  void map_all(Seif& filter) {
    for (double y = 0.0; y < side; y += 8.0) {
      for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, y), Eigen::Vector2d(side, y),
                                            Eigen::Vector2d(side, y + 4), Eigen::Vector2d(0, y + 4)}) {
        while (!is_at(corner)) go_towards(filter, corner, 0.5);
      }
    }
  }

  Eigen::Vector2d anywhere() {
    std::uniform_real_distribution<double> place(4.0, side - 4.0);
    const double x = place(random_);
    return {x, place(random_)};
  }

 private:
  static constexpr int per_side = static_cast<int>(side / 2.0) + 1;

  Scan look() {
    Scan scan{.t = t_, .observations = {}};
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      const Eigen::Vector2d p = inverse(truth_) * landmarks_[i];
      if (p.norm() > 5.0 || p.norm() < 0.2) continue;
      Observation z{.landmark = static_cast<LandmarkId>(i), .range = p.norm() + 0.02 * noise_(random_)};
      z.bearing = wrap_angle(std::atan2(p.y(), p.x()) + 0.01 * noise_(random_));
      z.covariance.diagonal() << 4e-4, 1e-4;
      scan.observations.push_back(z);
    }
    return scan;
  }

  std::vector<Eigen::Vector2d> landmarks_;
  Pose2 truth_;
  Eigen::Vector2d goal_ = Eigen::Vector2d::Zero();  // of wander()
  double t_ = 0.0;
  std::mt19937_64 random_;
  std::normal_distribution<double> noise_;
};

struct Habit {
  std::string name;
  /// One update. `k` counts them.
  std::int64_t (*update)(FieldDrive& drive, Seif& filter, int k);
};

/// Six seeds have 30,000 to 58,000, and up to 79,000 where the robot is carried elsewhere: one zone has both places
/// then. A field four times as large asks for no more.
constexpr std::int64_t most_blocks = 100'000;

class RobotThat : public testing::TestWithParam<Habit> {};

const Habit habits[] = {
    {"StandsStill", [](FieldDrive& drive, Seif& filter, int) { return drive.go(filter, 0.0); }},
    {"TurnsRoundWhileAPlanRuns",
     [](FieldDrive& drive, Seif& filter, int k) {
       const Pose2 back{0.0, 0.0, std::numbers::pi};
       return k % 9 == 8 ? drive.step_to(filter, drive.truth() * back) : drive.go(filter, 0.5);
     }},
    {"Dithers",
     [](FieldDrive& drive, Seif& filter, int k) { return drive.go(filter, k / 5 % 2 == 0 ? 0.6 : -0.6); }},
    {"IsCarriedElsewhere",
     [](FieldDrive& drive, Seif& filter, int k) {
       if (k % 12 > 0) return drive.go(filter, 0.1);
       const Eigen::Vector2d place = drive.anywhere();
       return drive.step_to(filter, {place.x(), place.y(), 0.1 * k});
     }},
    {"DrivesFasterThanPlansAreMade",
     [](FieldDrive& drive, Seif& filter, int) { return drive.wander(filter, 3.0); }},
};

INSTANTIATE_TEST_SUITE_P(Knows, RobotThat, testing::ValuesIn(habits),
                         [](const auto& habit) { return habit.param.name; });

TEST_P(RobotThat, NeverAsksForMoreThanTheBoundOfAnUpdate) {
  FieldDrive drive(1);
  Seif filter(drive.setup(), SeifOptions{});
  drive.map_all(filter);
  const Eigen::Vector2d middle(FieldDrive::side / 2, FieldDrive::side / 2);
  while (!drive.is_at(middle)) drive.go_towards(filter, middle, 0.5);
  const std::size_t memory = filter.memory_bytes();
  std::int64_t most = 0;
  const int updates = test::under_sanitizer ? 100 : 1'000;
  for (int k = 0; k < updates; ++k) most = std::max(most, GetParam().update(drive, filter, k));
  EXPECT_LE(most, most_blocks);
  EXPECT_LE(filter.memory_bytes(), 3 * memory);  // 1.0 to 2.2 times, where places far apart are in one zone
  const Pose2& truth = drive.truth();
  const Eigen::Vector3d error(filter.pose().x - truth.x, filter.pose().y - truth.y,
                              wrap_angle(filter.pose().theta - truth.theta));
  EXPECT_LT(error.dot(filter.pose_covariance().value().inverse() * error) / 3.0, 4.0);  // NEES
}

}  // namespace
}  // namespace seif
