#include "harness/live/running_figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <vector>

#include "harness/live/pacer.hpp"
#include "harness/live/thrift.hpp"

namespace harness {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(QuantileCounts, AreTheQuantilesToOnePercent) {
  std::mt19937_64 random(1);
  std::lognormal_distribution<double> times(3.0, 1.0);
  std::vector<double> values(10'000);
  QuantileCounts counts;
  for (double& value : values) counts.add(value = times(random));
  std::ranges::sort(values);
  for (const double share : {0.5, 0.9, 0.99})
    EXPECT_NEAR(counts.quantile(share) / values[static_cast<std::size_t>(share * 10'000) - 1], 1.0, 0.011);
  EXPECT_EQ(QuantileCounts().quantile(0.5), 0.0);
}

TEST(QuantileCounts, TakeAnyNumber) {
  QuantileCounts counts;
  for (const double value : {0.0, 1e300, std::nan(""), -1.0}) counts.add(value);
  EXPECT_TRUE(std::isfinite(counts.quantile(0.99)));
}

TEST(RunningFigures, AreThoseOfTheUpdates) {
  RunningFigures figures;
  UpdateRecord record;
  for (int i = 1; i <= 3; ++i) {
    record.t = i;
    record.times.update = 10.0 * i;
    record.true_pose = seif::Pose2{};
    record.est_pose = {0.1 * i, 0.0, 0.0};
    record.est_covariance = 0.01 * Eigen::Matrix3d::Identity();
    figures.update(record);
  }
  EXPECT_NEAR(*figures.figures().error, 0.3, 1e-12);
  EXPECT_NEAR(*figures.figures().rmse, std::sqrt((0.01 + 0.04 + 0.09) / 3.0), 1e-12);
  EXPECT_NEAR(*figures.figures().three_sigma, 0.3, 1e-12);
  EXPECT_NEAR(*figures.figures().nees, 3.0, 1e-9);
  std::vector<LiveChartPoint> points;
  figures.hand_over(points);
  EXPECT_EQ(points.size(), 3U);
  figures.hand_over(points);
  EXPECT_TRUE(points.empty());
}

TEST(RunningFigures, KeepBoundedManyPointsThatNobodyTakes) {
  RunningFigures figures;
  UpdateRecord record;
  for (int i = 0; i < 100'000; ++i) {
    record.t = i;
    figures.update(record);
  }
  std::vector<LiveChartPoint> points;
  figures.hand_over(points);
  EXPECT_LE(points.size(), 1024U);
  EXPECT_EQ(points.front().t, 0.0F);
}

TEST(Thrift, LeavesTheRestOfTheTimeToTheRun) {
  Thrift thrift(0.02, 0.5, milliseconds(33));
  Thrift::Clock::time_point now{};
  Thrift::Clock::duration spent{};
  const Thrift::Clock::duration cost = milliseconds(3);
  for (now += seconds(1); now.time_since_epoch() < seconds(101); now += milliseconds(1)) {
    if (!thrift.may(now, false)) continue;
    thrift.spent(now, cost);
    EXPECT_FALSE(thrift.may(now + milliseconds(32), true));
    EXPECT_TRUE(thrift.may(now + milliseconds(33), true));
    spent += cost;
  }
  EXPECT_LE(spent, seconds(2) + cost);
  EXPECT_GE(spent, milliseconds(1900));
}

TEST(Pacer, KeepsPaceAndForgetsWhatASlowMachineHasLost) {
  Pacer pacer;
  Pacer::Clock::time_point now{};
  pacer.set_speed(2.0, 10.0, now);
  EXPECT_EQ(pacer.due(12.0, now), now + seconds(1));
  now += seconds(5);
  EXPECT_EQ(pacer.due(12.0, now), now);               // four seconds late
  EXPECT_EQ(pacer.due(14.0, now), now + seconds(1));  // and no hurry afterwards
  pacer.set_speed(INFINITY, 14.0, now);
  EXPECT_EQ(pacer.due(1e9, now), now);
}

}  // namespace harness
