#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "driver.hpp"

namespace sim {
namespace {

/// About `count` landmarks, one in 16 m^2, on a jittered grid around the origin. A larger world has the same
/// landmarks in its middle.
worlds::World forest(int count) {
  constexpr double spacing = 4.0;
  const int half = static_cast<int>(std::lround(0.5 * std::sqrt(count)));
  worlds::World world;
  for (int i = -half; i < half; ++i) {
    for (int k = -half; k < half; ++k) {
      std::mt19937 random(static_cast<std::uint32_t>((i + 5000) * 10000 + k + 5000));
      std::uniform_real_distribution<double> jitter(1.0, 3.0);
      const double x = i * spacing + jitter(random);
      world.landmarks.push_back({{x, k * spacing + jitter(random)}, 0.1});
    }
  }
  return world;
}

/// A drive of 60 s with five scans a second.
SimulatorCounts counts_of_a_drive(const worlds::World& world) {
  const auto simulator = make_simulator(world);
  std::vector<int> candidates;
  for (int i = 0; i < 300; ++i) {
    drive_for(*simulator, world, 0.2, {0.8, 0.3 * std::sin(0.02 * i)});
    const Eigen::Vector2d sensor = simulator->robot().position;
    simulator->landmarks_within(sensor, 8.0, candidates);
    for (const int landmark : candidates) {
      static_cast<void>(simulator->line_of_sight(sensor, landmark));
    }
  }
  return simulator->counts();
}

TEST(Work, OfStepsAndScansDoesNotGrowWithTheWorld) {
  const SimulatorCounts small = counts_of_a_drive(forest(1000));
  const SimulatorCounts large = counts_of_a_drive(forest(50000));
  EXPECT_EQ(small.steps, 300 * 48);
  EXPECT_EQ(large.steps, small.steps);
  const auto grew = [](std::int64_t a, std::int64_t b) {
    return static_cast<double>(b) / static_cast<double>(a);
  };
  EXPECT_NEAR(grew(small.objects_stepped, large.objects_stepped), 1.0, 0.1);
  EXPECT_NEAR(grew(small.rays, large.rays), 1.0, 0.1);
  EXPECT_NEAR(grew(small.candidates, large.candidates), 1.0, 0.1);
  // Ground, chassis and two wheels, and only a few of the thousands of landmarks.
  EXPECT_GE(large.objects_stepped, 4 * large.steps);
  EXPECT_LT(large.objects_stepped, 8 * large.steps);
  EXPECT_GT(large.rays, 300 * 5);
}

// Two simulators side by side in one process, and a third that is built after memory was used and freed. The
// drive has collisions, slip and streaming.
TEST(Determinism, TheSameWorldGivesTheSameBits) {
  worlds::World world = forest(400);
  world.physics.patches = {{{2, -3}, {5, 3}, 0.1}};
  world.walls.push_back({{{6, -6}, {7, 6}}, 0.1, 1.0});
  const auto command = [](int i) { return Command{i % 700 < 500 ? 1.0 : -0.6, std::sin(0.003 * i)}; };
  constexpr int steps = 10000;
  std::vector<std::array<std::uint64_t, 7>> trace;
  {
    const auto a = make_simulator(world), b = make_simulator(world);
    for (int i = 0; i < steps; ++i) {
      a->step(command(i));
      b->step(command(i));
      trace.push_back(bits(a->robot()));
      ASSERT_EQ(bits(b->robot()), trace.back()) << i;
    }
  }
  const auto c = make_simulator(world);
  for (int i = 0; i < steps; ++i) {
    c->step(command(i));
    ASSERT_EQ(bits(c->robot()), trace[static_cast<std::size_t>(i)]) << i;
  }
}

// Queries change nothing.
TEST(Determinism, QueriesDoNotDisturbTheMotion) {
  const worlds::World world = forest(400);
  const auto asked = make_simulator(world), left_alone = make_simulator(world);
  std::vector<int> found;
  for (int i = 0; i < 3000; ++i) {
    asked->step({1.0, 0.5});
    left_alone->step({1.0, 0.5});
    asked->landmarks_within(asked->robot().position, 8.0, found);
    for (const int landmark : found) {
      static_cast<void>(asked->line_of_sight(asked->robot().position, landmark));
    }
  }
  EXPECT_EQ(bits(asked->robot()), bits(left_alone->robot()));
}

}  // namespace
}  // namespace sim
