// The live path (physics, sensing, estimation, recording) allocates nothing once the robot knows its way.

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "allocation_counter.hpp"
#include "harness/fixtures.hpp"
#include "harness/recording/recorder.hpp"
#include "harness/simulation/simulated_stream.hpp"

namespace harness {
namespace {

class LiveLoopIn : public testing::TestWithParam<worlds::Engine> {};

INSTANTIATE_TEST_SUITE_P(Engines, LiveLoopIn,
                         testing::Values(worlds::Engine::bullet, worlds::Engine::kinematic),
                         [](const auto& engine) {
                           return engine.param == worlds::Engine::bullet ? "Bullet" : "Kinematic";
                         });

TEST_P(LiveLoopIn, AllocatesNothingFromTheThirdRoundOn) {
  if (COUNTS_ALLOCATIONS == 0) GTEST_SKIP() << "the sanitizer has a malloc of its own";
  const TemporaryFolder folder;
  worlds::World world = test::small_world();  // a round takes about 40 s
  world.physics.engine = GetParam();
  world.duration = 240.0;
  world.scoring.interval = 1e6;  // scoring is not on the live path
  world.estimators = {test::choice("seif_report")};

  Believers believers;
  SimulatedStream stream(world, steering_pose(world.drive.pose_from, believers));
  believers.estimators =
      make_estimators(test::test_registry(), world.estimators, stream.description(), world.seed);
  const std::vector<std::string> names{"seif_report"};
  Recorder recorder(folder.path(), stream.description(), names);
  LiveLoop loop(stream, believers, {&recorder}, stream.description(), world.scoring);
  long after_two_rounds = 0;
  long at_the_end = 0;
  const std::atomic<bool> stop = false;
  loop.run(stop, [&](const LoopCounts& counts) {
    if (counts.t <= 100.0) after_two_rounds = allocations();
    at_the_end = allocations();
  });
  EXPECT_GT(after_two_rounds, 0);
  EXPECT_EQ(at_the_end, after_two_rounds);
}

}  // namespace
}  // namespace harness
