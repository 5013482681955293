// Options that change while a filter runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "ring_drive.hpp"
#include "seif/registry.hpp"
#include "seif/tree/array_pool.hpp"

namespace seif {
namespace {

constexpr int landmarks_of_ring = 60;
constexpr int steps = 40;

Options defaults_of(const EstimatorType& type) {
  Options options;
  for (const OptionSpec& spec : type.options) options[spec.key] = spec.fallback;
  return options;
}

double number_of(const OptionValue& value) {
  const auto* whole = std::get_if<std::int64_t>(&value);
  return whole != nullptr ? static_cast<double>(*whole) : std::get<double>(value);
}

/// Another value of an option that makes a difference on the ring.
OptionValue other_value(const OptionSpec& spec) {
  if (spec.key == "theta_x") return std::int64_t{3};
  if (spec.key == "theta_max") return std::int64_t{20};
  if (spec.key == "K") return std::int64_t{0};
  return spec.key == "gate" ? 2.0 : 1.0;
}

Pose2 pose_after_drive(Estimator& filter) {
  test::RingDrive drive(landmarks_of_ring, 1);
  for (int i = 0; i < steps; ++i) drive.step(filter);
  return filter.pose();
}

}  // namespace

/// Before its first motion a filter whose option changes is the filter that was made with that value: the same bits.
/// The value matters: with the default the pose is another one.
TEST(ChangeOption, DoesWhatTheOptionDoes) {
  const Registry registry = standard_estimators();
  const EstimatorSetup setup = test::RingDrive(landmarks_of_ring, 1).setup();
  int changeable = 0;
  for (const EstimatorType& type : registry.types()) {
    const Options defaults = defaults_of(type);
    for (const OptionSpec& spec : type.options) {
      if (!spec.changeable) continue;
      ++changeable;
      Options chosen = defaults;
      chosen[spec.key] = other_value(spec);
      const std::unique_ptr<Estimator> made = type.make(setup, chosen);
      const std::unique_ptr<Estimator> changed = type.make(setup, defaults);
      const std::unique_ptr<Estimator> plain = type.make(setup, defaults);
      ASSERT_TRUE(changed->change_option(spec.key, number_of(other_value(spec))))
          << type.name << ' ' << spec.key;
      const Pose2 pose = pose_after_drive(*changed);
      const Pose2 expected = pose_after_drive(*made);
      EXPECT_EQ(pose.x, expected.x) << type.name << ' ' << spec.key;
      EXPECT_EQ(pose.theta, expected.theta) << type.name << ' ' << spec.key;
      // Alone theta_x says little of a filter that drops its links in bursts.
      if (spec.key == "theta_x" && !spec.not_above.empty()) continue;
      EXPECT_NE(pose.x, pose_after_drive(*plain).x) << type.name << ' ' << spec.key;
    }
  }
  EXPECT_GE(changeable, 12);
}

TEST(ChangeOption, ChangesNothingThatItCannotChange) {
  const Registry registry = standard_estimators();
  const EstimatorSetup setup = test::RingDrive(landmarks_of_ring, 1).setup();
  for (const EstimatorType& type : registry.types()) {
    const std::unique_ptr<Estimator> filter = type.make(setup, defaults_of(type));
    EXPECT_FALSE(filter->change_option("no_such_option", 1.0)) << type.name;
    for (const OptionSpec& spec : type.options) {
      if (spec.changeable) continue;
      EXPECT_FALSE(filter->change_option(spec.key, 1.0)) << type.name << ' ' << spec.key;
    }
  }
}

TEST(ChangeOption, TakesEffectInTheMiddleOfADrive) {
  const Registry registry = standard_estimators();
  const EstimatorType& type = *registry.find("seif");
  test::RingDrive drive(landmarks_of_ring, 1);
  const std::unique_ptr<Estimator> filter = type.make(drive.setup(), defaults_of(type));
  int most_active = 0;
  for (int i = 0; i < 60; ++i) {
    drive.step(*filter);
    most_active = std::max(most_active, static_cast<int>(filter->counts().active_landmarks));
  }
  ASSERT_GT(most_active, 13);
  ASSERT_TRUE(filter->change_option("theta_max", 12));
  for (int i = 0; i < 60; ++i) {
    drive.step(*filter);
    EXPECT_LE(filter->counts().active_landmarks, 13);  // one more may be in view
  }
}

TEST(ArrayPool, HandsOutMemoryThatBeginsWithACacheLine) {
  ArrayPool pool;
  std::vector<ArrayPool::Array> arrays;
  for (std::size_t size = 1; size < 100; ++size) {
    arrays.push_back(pool.take(size));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(arrays.back().data()) % 64, 0U);
  }
}

}  // namespace seif
