#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "world_files.hpp"
#include "worlds/geometry.hpp"
#include "worlds/path.hpp"

namespace worlds {
namespace {

using test::fake_estimators;
using test::gallery_file;

World load(const std::string& name) {
  LoadResult result = load_world(gallery_file(name), {}, fake_estimators());
  EXPECT_TRUE(result.world) << test::text_of(result.problems);
  return result.world.value_or(World{});
}

class EveryGalleryWorld : public testing::TestWithParam<std::string> {};

TEST_P(EveryGalleryWorld, LoadsWithTheNameOfItsFile) { EXPECT_EQ(load(GetParam()).name, GetParam()); }

void expect_equal(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  EXPECT_EQ(a, b);
}

TEST_P(EveryGalleryWorld, ResolvesToAFileThatLoadsToTheSameBits) {
  const LoadResult first = load_world(gallery_file(GetParam()), {}, fake_estimators(), "1.0");
  ASSERT_TRUE(first.world) << test::text_of(first.problems);
  const test::Folder folder;
  const auto file = folder.write("world.yaml", first.resolved);
  const LoadResult second = load_world(file, {}, fake_estimators(), "1.0");
  ASSERT_TRUE(second.world) << test::text_of(second.problems) << first.resolved;
  EXPECT_EQ(second.resolved, first.resolved);
  const World& a = *first.world;
  const World& b = *second.world;
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.duration, b.duration);
  EXPECT_EQ(a.robot.start.heading, b.robot.start.heading);
  EXPECT_EQ(a.robot.max_turn_rate, b.robot.max_turn_rate);
  EXPECT_EQ(a.robot.max_turn_acceleration, b.robot.max_turn_acceleration);
  EXPECT_EQ(a.landmark_sensor.fov, b.landmark_sensor.fov);
  EXPECT_EQ(a.landmark_sensor.bearing_sd, b.landmark_sensor.bearing_sd);
  EXPECT_EQ(a.start_estimate.heading_sd, b.start_estimate.heading_sd);
  EXPECT_EQ(a.encoders.distance_sd, b.encoders.distance_sd);
  expect_equal(a.drive.path, b.drive.path);
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) {
    EXPECT_EQ(a.landmarks[i].position, b.landmarks[i].position);
    EXPECT_EQ(a.landmarks[i].radius, b.landmarks[i].radius);
  }
  ASSERT_EQ(a.estimators.size(), b.estimators.size());
  for (std::size_t i = 0; i < a.estimators.size(); ++i) {
    EXPECT_EQ(a.estimators[i].name, b.estimators[i].name);
    EXPECT_EQ(a.estimators[i].options, b.estimators[i].options);
  }
  test::expect_equal(a.film, b.film);
}

TEST_P(EveryGalleryWorld, LastsAsLongAsItsPathTakes) {
  for (const World& world : worlds_of_robots(load(GetParam()))) {
    // A corner costs the robot about 3 s: it slows down, turns by 90 degrees at 90 degrees/s, and speeds up
    // again.
    const double corners = 3.0 * static_cast<double>(world.drive.path.size());
    EXPECT_GE(world.duration, length(world.drive.path, world.drive.closed) / world.drive.speed + corners);
  }
}

TEST_P(EveryGalleryWorld, KeepsThePathClearForTheRobot) {
  constexpr double least = 0.6;
  for (const World& world : worlds_of_robots(load(GetParam()))) {
    for (const Segment& leg : legs(driven_path(world), false)) {
      for (const Landmark& landmark : world.landmarks) {
        ASSERT_GE(distance(landmark.position, leg) - landmark.radius, least - 1e-9);
      }
      for (const Rectangle& solid : solid_rectangles(world)) ASSERT_GE(distance(leg, solid), least);
    }
  }
}

/// Landmarks in range, in the field of view and not behind a wall, averaged over the path.
double mean_in_view(const World& world) {
  const std::vector<Rectangle> solids = solid_rectangles(world);
  const double step = std::max(1.0, length(world.drive.path, world.drive.closed) / 200);  // [m]
  double seen = 0;
  double places = 0;
  for (const Segment& leg : legs(world.drive.path, world.drive.closed)) {
    const double extent = (leg.to - leg.from).norm();
    const Eigen::Vector2d ahead = (leg.to - leg.from) / extent;
    for (double at = 0; at < extent; at += step) {
      const Eigen::Vector2d p = leg.from + at * ahead;
      places += 1;
      for (const Landmark& landmark : world.landmarks) {
        const Eigen::Vector2d to = landmark.position - p;
        const bool in_range = to.norm() <= world.landmark_sensor.max_range;
        if (!in_range || std::acos(ahead.dot(to.normalized())) > 0.5 * world.landmark_sensor.fov) continue;
        const bool hidden = std::any_of(solids.begin(), solids.end(), [&](const Rectangle& solid) {
          return distance(Segment{p, landmark.position}, solid) <= 0;
        });
        seen += hidden ? 0 : 1;
      }
    }
  }
  return seen / places;
}

TEST_P(EveryGalleryWorld, ShowsAHandfulOfLandmarksInAScan) {
  for (const World& world : worlds_of_robots(load(GetParam()))) {
    const double seen = mean_in_view(world);
    EXPECT_GE(seen, 5);
    EXPECT_LE(seen, 12);
  }
}

INSTANTIATE_TEST_SUITE_P(Gallery, EveryGalleryWorld, testing::ValuesIn(test::gallery()),
                         [](const auto& test) { return test.param; });

TEST(Gallery, HasTheLandmarksThatItPromises) {
  EXPECT_EQ(load("courtyard").landmarks.size(), 60U);
  EXPECT_EQ(load("report2002").landmarks.size(), 50U);
  EXPECT_EQ(load("orchard").landmarks.size(), 1000U);
  EXPECT_EQ(load("forest").landmarks.size(), 5000U);
}

TEST(Gallery, GivesTheReportItsFiveHundredUpdates) {
  const World world = load("report2002");
  EXPECT_EQ(world.duration * world.landmark_sensor.rate, 500.0);
  EXPECT_EQ(world.landmark_sensor.range_sd, 0.05);
  EXPECT_EQ(world.landmark_sensor.bearing_sd, 0.5 * degree);
}

TEST(Gallery, LetsTheOrchardsEveryRowBeSeen) {
  const World world = load("orchard");
  for (const Landmark& landmark : world.landmarks) {
    EXPECT_LT(distance(landmark.position, world.drive.path, false), world.landmark_sensor.max_range);
  }
}

TEST(Gallery, LetsTheCourtyardBeCalibrated) {
  const LoadResult result =
      load_world(gallery_file("courtyard"), {"sensors.encoders.calibrated=true"}, fake_estimators());
  ASSERT_TRUE(result.world);
  EXPECT_TRUE(result.world->encoders.calibrated);
}

}  // namespace
}  // namespace worlds
