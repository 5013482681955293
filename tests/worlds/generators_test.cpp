#include "worlds/generators.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "worlds/geometry.hpp"
#include "worlds/limits.hpp"
#include "worlds/path.hpp"

namespace worlds {
namespace {

using Eigen::Vector2d;

constexpr double rounding = 1e-12;  // [m]

/// A world with one of each thing that a landmark must keep clear of.
World furnished_world() {
  World world;
  world.ground_size = {40, 40};
  world.walls.push_back({{{-10, -10}, {10, -10}, {10, 10}}, 0.2, 1.0, false});
  world.boxes.push_back({{{5, 0}, 30 * degree}, {4, 2}, 1.0});
  world.landmarks.push_back({{-5, -5}, 0.5});
  world.drive.mode = DriveMode::loop;
  world.drive.closed = true;
  world.drive.path = {{-15, -15}, {15, -15}, {15, 15}, {-15, 15}};
  return world;
}

Generator whole_ground(Pattern pattern, const World& world) {
  Generator generator;
  generator.pattern = pattern;
  generator.min = -0.5 * world.ground_size;
  generator.max = 0.5 * world.ground_size;
  generator.count = 200;
  generator.skip_blocked = true;
  return generator;
}

Placed run(const Generator& generator, World& world, std::uint64_t seed = 1) {
  std::mt19937_64 random = generator_stream(seed, 0);
  return generate(generator, world, random);
}

class EveryPattern : public testing::TestWithParam<Pattern> {};

TEST_P(EveryPattern, KeepsClearOfEverything) {
  World world = furnished_world();
  Generator generator = whole_ground(GetParam(), world);
  generator.jitter = 0.3;
  generator.ring_radius = 10;
  generator.count = GetParam() == Pattern::ring ? 60 : 200;
  const Placed placed = run(generator, world);
  EXPECT_EQ(placed.placed, placed.wanted);
  EXPECT_GE(placed.placed, 30);
  EXPECT_EQ(world.landmarks.size(), static_cast<std::size_t>(placed.placed) + 1);
  const auto solids = solid_rectangles(world);
  const auto path = driven_path(world);
  for (std::size_t i = 1; i < world.landmarks.size(); ++i) {
    const auto& [p, radius] = world.landmarks[i];
    EXPECT_TRUE(on_ground(p, radius, world.ground_size));
    for (const Rectangle& solid : solids)
      EXPECT_GE(distance(p, solid) + rounding, generator.clear.walls + radius);
    EXPECT_GE(distance(p, path, false) + rounding, generator.clear.path + radius);
    EXPECT_GE((p - world.robot.start.position).norm() + rounding, footprint_radius(world.robot) + radius);
    for (std::size_t k = 0; k < i; ++k) {
      const Landmark& other = world.landmarks[k];
      EXPECT_GE((p - other.position).norm() + rounding, radius + other.radius + generator.clear.landmarks);
    }
  }
}

TEST_P(EveryPattern, GivesTheSameForTheSameSeedAlone) {
  const auto positions = [&](std::uint64_t seed) {
    World world = furnished_world();
    Generator generator = whole_ground(GetParam(), world);
    generator.jitter = 0.3;
    generator.count = 30;
    run(generator, world, seed);
    std::vector<Vector2d> result;
    for (const Landmark& landmark : world.landmarks) result.push_back(landmark.position);
    return result;
  };
  EXPECT_EQ(positions(7), positions(7));
  EXPECT_NE(positions(7), positions(8));
}

INSTANTIATE_TEST_SUITE_P(Generate, EveryPattern,
                         testing::Values(Pattern::uniform, Pattern::poisson_disk, Pattern::grid,
                                         Pattern::ring, Pattern::clusters, Pattern::corridor));

TEST(Generate, PlacesByDensity) {
  World world;
  Generator generator = whole_ground(Pattern::uniform, world);
  generator.count = 0;
  generator.density = 0.05;
  EXPECT_EQ(run(generator, world).placed, 80);
}

TEST(Generate, KeepsThePoissonDisksApart) {
  World world;
  Generator generator = whole_ground(Pattern::poisson_disk, world);
  generator.distance = 1.8;
  run(generator, world);
  for (std::size_t i = 0; i < world.landmarks.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE((world.landmarks[i].position - world.landmarks[k].position).norm(), 1.8);
    }
  }
}

TEST(Generate, PlacesGridsInTheMiddleOfTheirCells) {
  World world;
  Generator generator = whole_ground(Pattern::grid, world);
  generator.min = {1, 1};
  generator.max = {7, 5};
  generator.cell = {2, 4};
  EXPECT_EQ(run(generator, world).placed, 3);
  EXPECT_EQ(world.landmarks[0].position, Vector2d(2, 3));
  EXPECT_EQ(world.landmarks[2].position, Vector2d(6, 3));
}

TEST(Generate, PlacesCorridorsOnBothSidesOfTheLine) {
  World world;
  world.robot.start.position = {-15, -15};
  Generator generator = whole_ground(Pattern::corridor, world);
  generator.points = {{-8, 2}, {8, 2}};
  generator.offset = 1.5;
  generator.spacing = 2;
  const Placed placed = run(generator, world);
  EXPECT_EQ(placed.wanted, 16);
  EXPECT_EQ(placed.placed, 16);
  for (const Landmark& landmark : world.landmarks) {
    EXPECT_NEAR(std::abs(landmark.position.y() - 2), 1.5, rounding);
  }
}

TEST(Generate, SpreadsClustersAsTheirSdSays) {
  World world;
  world.ground_size = {400, 400};
  Generator generator = whole_ground(Pattern::clusters, world);
  generator.clusters = 1;
  generator.cluster_sd = 2;
  generator.count = 4000;
  generator.radius = 0.001;
  generator.clear = {0, 0, 0};
  run(generator, world);
  Vector2d mean = Vector2d::Zero();
  for (const Landmark& landmark : world.landmarks) mean += landmark.position / 4000;
  double variance = 0;
  for (const Landmark& landmark : world.landmarks)
    variance += (landmark.position - mean).squaredNorm() / 8000;
  EXPECT_NEAR(std::sqrt(variance), 2.0, 0.07);  // three sigma of the sd of 8,000 draws, 2 / sqrt(16,000) each
}

TEST(Generate, SaysHowManyItPlacedWhereThereIsTooLittleRoom) {
  World world;
  Generator generator = whole_ground(Pattern::poisson_disk, world);
  generator.distance = 5;
  generator.count = 1000;
  generator.max_tries = 100;
  const Placed placed = run(generator, world);
  EXPECT_EQ(placed.wanted, 1000);
  EXPECT_GT(placed.placed, 20);
  EXPECT_LT(placed.placed, 100);
  EXPECT_EQ(world.landmarks.size(), static_cast<std::size_t>(placed.placed));
}

TEST(Generate, FindsNoPlaceOnAGridThatIsBlockedUnlessItMaySkip) {
  World world = furnished_world();
  Generator generator = whole_ground(Pattern::grid, world);
  generator.skip_blocked = false;
  const Placed strict = run(generator, world);
  EXPECT_LT(strict.placed, strict.wanted);
  EXPECT_EQ(strict.wanted, 1600);
}

TEST(GeneratorStream, DiffersForEachSeedAndIndex) {
  EXPECT_EQ(generator_stream(1, 2)(), generator_stream(1, 2)());
  EXPECT_NE(generator_stream(1, 2)(), generator_stream(1, 3)());
  EXPECT_NE(generator_stream(1, 2)(), generator_stream(2, 2)());
  EXPECT_NE(generator_stream(1, 2)(), generator_stream(1 + (1ULL << 32U), 2)());
}

TEST(Generate, TakesTimeInProportionToTheLandmarks) {
  const auto seconds = [](std::int64_t count) {
    World world;
    world.ground_size = Vector2d::Constant(std::sqrt(static_cast<double>(count) / 0.1));
    world.drive.mode = DriveMode::serpentine;
    world.drive.path = serpentine(-0.45 * world.ground_size, 0.45 * world.ground_size, 20);
    Generator generator = whole_ground(Pattern::poisson_disk, world);
    generator.count = count;
    generator.distance = 1.5;
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(run(generator, world).placed, count);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double small = seconds(10'000);
  const double large = seconds(100'000);
  RecordProperty("seconds_for_100000", std::to_string(large));
  // Ten times the landmarks are ten times the work; a pass over all landmarks for each one would be a hundred
  // times. The factor of 40 allows for slower caches and noise.
  EXPECT_LT(large, 40 * small + 0.1);
}

TEST(Generate, GivesUpAfterManyTriesInAllAlthoughOneInAThousandFindsAPlace) {
  World world;
  world.ground_size = {60, 60};
  Generator generator;
  generator.pattern = Pattern::ring;
  generator.count = 1000;
  generator.radius = 0.001;
  generator.jitter = 1000;
  generator.max_tries = 1'000'000;
  std::mt19937_64 random(1);
  set_limits({.fruitless_tries = 20'000});
  const Placed placed = generate(generator, world, random);
  set_limits({});
  EXPECT_EQ(placed.wanted, 1000);
  EXPECT_GT(placed.placed, 40);
  EXPECT_LT(placed.placed, 160) << "90,000 tries in all";
}

}  // namespace
}  // namespace worlds
