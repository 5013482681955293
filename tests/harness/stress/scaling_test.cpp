#include "harness/stress/scaling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace harness {
namespace {

StressRow row_of(std::int64_t landmarks) {
  const auto n = static_cast<double>(landmarks);
  StressRow row;
  row.landmarks = landmarks;
  row.step_us = Percentiles{20.0, 21.0, 22.0, 23.0};
  row.estimators.resize(2);
  row.estimators[0].name = "dense";
  row.estimators[0].update_us = Percentiles{3e-3 * n * n, 0, 0, 0};
  row.estimators[1].name = "skipped";
  return row;
}

TEST(Scaling, FindsThePowerThatTimeGrowsWith) {
  const std::vector<StageScaling> stages = scaling_of({row_of(100), row_of(1'000), row_of(10'000)});
  ASSERT_EQ(stages.size(), 2U) << "what was not measured has no slope";
  EXPECT_EQ(stages[0].name, "physics step");
  EXPECT_NEAR(stages[0].slope->value, 0.0, 1e-12);
  EXPECT_EQ(stages[1].name, "dense");
  EXPECT_NEAR(stages[1].slope->value, 2.0, 1e-12);
  EXPECT_NEAR(stages[1].slope->interval->high, 2.0, 1e-6);
}

}  // namespace
}  // namespace harness
