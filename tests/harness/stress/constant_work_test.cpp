// Physics, sensing, estimation and recording do the same work in a large world and in a small one.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>

#include "allocation_counter.hpp"
#include "harness/fixtures.hpp"
#include "harness/stress/stress.hpp"

namespace harness {
namespace {

struct Work {
  double objects = 0.0;      // [-] for each physics step
  double rays = 0.0;         // [-] for each scan
  double candidates = 0.0;   // [-] for each scan
  double blocks = 0.0;       // [-] median of an update
  double allocations = 0.0;  // [-] for each update
};

Work work_with(std::int64_t landmarks) {
  const TemporaryFolder folder;
  StressPlan plan;
  plan.world.landmarks = landmarks;
  plan.world.estimators = {"seif"};
  plan.updates = 3'000;
  plan.places = 1;  // building a world allocates
  plan.folder = folder.path();
  plan.quiet = true;
  long first = 0;
  long last = 0;
  plan.after_each_update = [&] {
    last = allocations();
    if (first == 0) first = last;
  };
  const std::atomic<bool> stop = false;
  const StressRow row = stress_row(plan, test::test_registry(), stop);
  EXPECT_EQ(row.updates, plan.updates);
  EXPECT_GE(row.estimators.at(0).landmarks, 0.999 * static_cast<double>(landmarks));
  const auto updates = static_cast<double>(row.updates);
  return {static_cast<double>(row.counts.objects_stepped) / static_cast<double>(row.counts.steps),
          static_cast<double>(row.counts.rays) / updates,
          static_cast<double>(row.counts.candidates) / updates, row.estimators[0].blocks->p50,
          static_cast<double>(last - first) / updates};
}

TEST(ConstantWork, FromAThousandLandmarksToFiftyThousand) {
  const Work small = work_with(1'000);
  const Work large = work_with(50'000);
  EXPECT_NEAR(large.objects / small.objects, 1.0, 0.1);
  EXPECT_NEAR(large.rays / small.rays, 1.0, 0.1);
  EXPECT_NEAR(large.candidates / small.candidates, 1.0, 0.1);
  EXPECT_NEAR(large.blocks / small.blocks, 1.0, 0.1);
  EXPECT_GT(large.rays, 3.0);
  EXPECT_GT(large.blocks, 100.0);
  // The remaining allocations come from buffers that have not yet had their largest size: in a large map,
  // messages of places that the robot has passed only once.
  EXPECT_LT(small.allocations, 0.5);
  EXPECT_LT(large.allocations, 0.5);
}

}  // namespace
}  // namespace harness
