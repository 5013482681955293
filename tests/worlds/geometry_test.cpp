#include "worlds/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "worlds/path.hpp"
#include "worlds/shape_tree.hpp"

namespace worlds {
namespace {

using Eigen::Vector2d;

constexpr double tolerance = 1e-12;  // [m] rounding at metre scale

/// The smallest distance over a fine grid of points of the rectangle: an upper bound, which is close for points
/// that are not far away.
double sampled_distance(const Vector2d& p, const Rectangle& r, int steps) {
  const Vector2d side(-r.axis.y(), r.axis.x());
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = -steps; i <= steps; ++i) {
    for (int k = -steps; k <= steps; ++k) {
      const Vector2d q = r.centre + r.axis * r.half.x() * i / steps + side * r.half.y() * k / steps;
      nearest = std::min(nearest, (p - q).norm());
    }
  }
  return nearest;
}

TEST(Distance, OfAPointAndABoxIsToTheNearestPointOfTheBox) {
  const Rectangle box = rectangle(Box{{{1, 2}, 30 * degree}, {4, 2}, 1.0});
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-6, 6);
  for (int i = 0; i < 30; ++i) {
    const Vector2d p(coordinate(random), coordinate(random));
    const double exact = distance(p, box);
    const double sampled = sampled_distance(p, box, 50);
    EXPECT_LE(exact, sampled + tolerance);
    EXPECT_NEAR(exact, sampled, 0.025);  // half the diagonal of a raster cell of 0.04 m x 0.02 m
  }
  EXPECT_EQ(distance(Vector2d(1.1, 2.1), box), 0.0);
}

TEST(Distance, OfAPointAndASegmentIsToItsInsideOrItsEnds) {
  const Segment segment{{0, 0}, {10, 0}};
  EXPECT_NEAR(distance(Vector2d(5, 3), segment), 3, tolerance);
  EXPECT_NEAR(distance(Vector2d(-3, 4), segment), 5, tolerance);
  EXPECT_NEAR(distance(Vector2d(13, -4), segment), 5, tolerance);
  EXPECT_NEAR(distance(Vector2d(3, 4), Segment{{0, 0}, {0, 0}}), 5, tolerance);
}

TEST(Distance, OfAPointAndAPolylineCountsTheClosingLegOfAClosedOne) {
  const std::vector<Vector2d> corners = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  EXPECT_NEAR(distance(Vector2d(-1, 2), corners, true), 1, tolerance);
  EXPECT_NEAR(distance(Vector2d(-1, 2), corners, false), std::sqrt(5), tolerance);
  EXPECT_NEAR(distance(Vector2d(0, 1), {{0, 0}}, false), 1, tolerance);
}

TEST(Distance, OfSegmentsIsZeroWhereTheyMeet) {
  EXPECT_EQ(distance(Segment{{-1, -1}, {1, 1}}, Segment{{-1, 1}, {1, -1}}), 0.0);
  EXPECT_EQ(distance(Segment{{0, 0}, {1, 0}}, Segment{{1, 0}, {2, 5}}), 0.0);
  EXPECT_NEAR(distance(Segment{{0, 0}, {1, 0}}, Segment{{0, 2}, {1, 1}}), 1, tolerance);
  EXPECT_NEAR(distance(Segment{{0, 0}, {1, 0}}, Segment{{3, 0}, {4, 0}}), 2, tolerance);
}

TEST(Distance, OfASegmentAndABoxIsZeroInsideAndAcross) {
  const Rectangle box{{0, 0}, {1, 0}, {2, 1}};
  EXPECT_EQ(distance(Segment{{-0.5, 0}, {0.5, 0}}, box), 0.0);
  EXPECT_EQ(distance(Segment{{-5, 0}, {5, 0}}, box), 0.0);
  EXPECT_NEAR(distance(Segment{{-5, 3}, {5, 3}}, box), 2, tolerance);
  EXPECT_NEAR(distance(Segment{{5, 5}, {6, 6}}, box), 5, tolerance);
}

TEST(Legs, LeaveOutThoseOfNoLength) {
  const std::vector<Vector2d> points = {{0, 0}, {0, 0}, {1, 0}, {1, 1}};
  EXPECT_EQ(legs(points, false).size(), 2U);
  EXPECT_EQ(legs(points, true).size(), 3U);
  EXPECT_TRUE(legs({{1, 1}}, true).empty());
  EXPECT_NEAR(length(points, true), 2 + std::numbers::sqrt2, tolerance);
}

TEST(Serpentine, CoversTheRectangleInLanesNoFurtherApartThanAsked) {
  const Vector2d min(-3, 1);
  const Vector2d max(7, 8);
  for (const double lane : {0.7, 2.0, 3.5, 7.0, 100.0}) {
    const auto path = serpentine(min, max, lane);
    EXPECT_EQ(path.front(), min);
    EXPECT_EQ(path.back().y(), max.y());
    for (double x = min.x(); x <= max.x(); x += 0.5) {
      for (double y = min.y(); y <= max.y(); y += 0.25) {
        EXPECT_LE(distance(Vector2d(x, y), path, false), std::min(lane, 7.0) / 2 + tolerance);
      }
    }
    for (const Segment& leg : legs(path, false)) {
      EXPECT_TRUE(leg.from.x() == leg.to.x() || leg.from.y() == leg.to.y());
      EXPECT_LE(std::abs(leg.to.y() - leg.from.y()), lane + tolerance);
    }
  }
  EXPECT_EQ(serpentine(min, max, 0.7).size(),
            22U);  // ten gaps, although 7 / 0.7 is more than 10 in floating point
}

/// Random rectangles, long and short ones, and how far each of them is felt.
std::vector<Rectangle> random_rectangles(std::mt19937& random, std::vector<double>& reaches) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Rectangle> shapes;
  for (int i = 0; i < 60; ++i) {
    const double angle = 7 * unit(random);
    const Vector2d half(std::pow(unit(random), 4) * 20, unit(random) * 0.5);
    shapes.push_back({{40 * unit(random), 40 * unit(random)}, {std::cos(angle), std::sin(angle)}, half});
    reaches.push_back(std::pow(unit(random), 3) * 4);
  }
  return shapes;
}

TEST(ShapeTree, FindsWhatASearchThroughAllFinds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-5, 45);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> reaches;
    const std::vector<Rectangle> shapes = random_rectangles(random, reaches);
    const ShapeTree tree(shapes, reaches);
    for (int query = 0; query < 50; ++query) {
      const Segment segment{{place(random), place(random)}, {place(random), place(random)}};
      const double reach = query % 5;
      std::set<std::size_t> near_point, near_segment, found_by_point, found_by_segment;
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        if (distance(segment.from, shapes[i]) <= reach + reaches[i]) near_point.insert(i);
        if (distance(segment, shapes[i]) <= reach + reaches[i]) near_segment.insert(i);
      }
      const auto gather = [&](std::set<std::size_t>& found, const auto& from) {
        tree.any_near(from, reach, [&](std::size_t i, const Rectangle& shape) {
          if (distance(from, shape) <= reach + reaches[i]) found.insert(i);
          return false;
        });
      };
      gather(found_by_point, segment.from);
      gather(found_by_segment, segment);
      ASSERT_EQ(found_by_point, near_point);
      ASSERT_EQ(found_by_segment, near_segment);
    }
  }
  EXPECT_FALSE(ShapeTree({}).any_near(Vector2d(0, 0), 9, [](std::size_t, const Rectangle&) { return true; }));
}

TEST(ShapeTree, LooksAtFewOfAHundredThousandShortLegs) {
  constexpr int legs_of_path = 100'000;
  constexpr double step = 1e-3;  // [m]
  std::vector<Rectangle> path;
  for (int i = 0; i < legs_of_path; ++i)
    path.push_back(rectangle(Segment{{step * i, 0}, {step * (i + 1), 0}}, 0));
  const ShapeTree tree(std::move(path), std::vector<double>(legs_of_path, step));
  std::int64_t looks = 0;
  for (int i = 0; i < legs_of_path; ++i) {
    const bool is_near =
        tree.any_near(Vector2d(step * i, 1.5 * step), 0.0, [&](std::size_t, const Rectangle& leg) {
          ++looks;
          return distance(Vector2d(step * i, 1.5 * step), leg) < step;
        });
    ASSERT_FALSE(is_near);
  }
  EXPECT_LT(looks, 20 * std::int64_t{legs_of_path});
}

TEST(DrivenPath, FollowsCommandsAsAUnicycleDoes) {
  World world;
  world.duration = 10;
  world.robot.start = {{1, 2}, std::numbers::pi / 2};
  world.drive.mode = DriveMode::commands;
  // A straight metre, then half a circle of radius 1 to the left, then nothing.
  world.drive.commands = {{0, 0.5, 0}, {2, 0.5, 0.5}, {2 + 2 * std::numbers::pi, 0, 0}};
  const auto path = driven_path(world);
  // The steps are chords of 0.05 rad: 1 / (sin(x/2) / (x/2)) - 1 of a circle's radius, 1e-4.
  EXPECT_NEAR(path.back().x(), -1, 1e-3);
  EXPECT_NEAR(path.back().y(), 3, 1e-3);
}

TEST(DrivenPath, LeadsFromTheStartAlongThePathAndBackIfClosed) {
  World world;
  world.robot.start.position = {9, 9};
  world.drive.mode = DriveMode::loop;
  world.drive.path = {{0, 0}, {1, 0}, {1, 1}};
  world.drive.closed = true;
  EXPECT_EQ(driven_path(world), (std::vector<Vector2d>{{9, 9}, {0, 0}, {1, 0}, {1, 1}, {0, 0}}));
}

}  // namespace
}  // namespace worlds
