#include "harness/stress/stress_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/fixtures.hpp"
#include "worlds/load.hpp"

namespace harness {
namespace {

worlds::World loaded(const StressWorldSpec& spec) {
  const TemporaryFolder folder;
  test::write_file(folder / "world.yaml", stress_world(spec));
  worlds::LoadResult result =
      worlds::load_world(folder / "world.yaml", {}, estimator_schemas(test::test_registry()));
  for (const worlds::Problem& problem : result.problems) ADD_FAILURE() << worlds::to_string(problem);
  return result.world.value();
}

double distance_to(const std::vector<Eigen::Vector2d>& closed, const Eigen::Vector2d& p) {
  double least = 1e9;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const Eigen::Vector2d from = closed[i];
    const Eigen::Vector2d way = closed[(i + 1) % closed.size()] - from;
    const double share = std::clamp((p - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (from + share * way - p).norm());
  }
  return least;
}

class StressWorld : public testing::TestWithParam<StressPattern> {};

INSTANTIATE_TEST_SUITE_P(Patterns, StressWorld,
                         testing::Values(StressPattern::serpentine, StressPattern::ring,
                                         StressPattern::forest),
                         [](const auto& pattern) {
                           return std::string(
                               stress_pattern_names.at(static_cast<std::size_t>(pattern.param)));
                         });

TEST_P(StressWorld, HasAsManyLandmarksAsAskedForAndAllWithinSightOfTheRound) {
  for (const std::int64_t landmarks : {20, 100, 1'001, 5'000}) {
    const StressWorldSpec spec{.pattern = GetParam(), .landmarks = landmarks, .estimators = {"seif"}};
    const worlds::World world = loaded(spec);
    ASSERT_EQ(world.landmarks.size(), static_cast<std::size_t>(landmarks));
    for (const worlds::Landmark& landmark : world.landmarks) {
      const double distance = distance_to(world.drive.path, landmark.position);
      EXPECT_LT(distance, world.landmark_sensor.max_range);
      EXPECT_GT(distance, 0.5) << "the robot has a width";
    }
  }
}

TEST_P(StressWorld, LetsTheRobotSeeAsMuchInALargeWorldAsInASmallOne) {
  const auto in_view = [](std::int64_t landmarks) {
    const worlds::World world = loaded({.pattern = GetParam(), .landmarks = landmarks, .estimators = {}});
    const std::vector<Eigen::Vector2d>& path = world.drive.path;
    double seen = 0;
    double places = 0;
    for (std::size_t i = 1; i < path.size(); ++i, ++places) {
      const Eigen::Vector2d here = 0.5 * (path[i - 1] + path[i]);
      for (const worlds::Landmark& landmark : world.landmarks)
        seen += (landmark.position - here).norm() < world.landmark_sensor.max_range ? 1 : 0;
    }
    return seen / places;
  };
  const double small = in_view(2'000);
  EXPECT_GT(small, 4.0);
  EXPECT_NEAR(in_view(20'000) / small, 1.0, 0.25);
}

TEST(StressWorld, BeginsInTheMidstOfTheMap) {
  const worlds::World world = loaded({.landmarks = 10'000, .estimators = {}});
  EXPECT_LT(std::abs(world.robot.start.position.y()), 8.1) << "a lane from the middle at the most";
}

}  // namespace
}  // namespace harness
