#include "harness/stress/timed_simulator.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "harness/fixtures.hpp"

namespace harness {
namespace {

TEST(TimedSimulator, ChangesNothingAndNotesEveryStep) {
  const worlds::World world = test::small_world();
  const auto alone = sim::make_simulator(world);
  std::vector<double> step_us;
  TimedSimulator timed(sim::make_simulator(world), step_us);
  for (int i = 0; i < 100; ++i) {
    alone->step({0.5, 0.2});
    timed.step({0.5, 0.2});
    ASSERT_EQ(timed.robot().position, alone->robot().position);
  }
  EXPECT_EQ(step_us.size(), 100U);
  for (const double us : step_us) EXPECT_GT(us, 0.0);
  EXPECT_EQ(timed.counts().objects_stepped, alone->counts().objects_stepped);
}

}  // namespace
}  // namespace harness
