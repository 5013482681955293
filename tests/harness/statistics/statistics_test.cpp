#include "harness/statistics/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace harness {
namespace {

using Sample = std::vector<double>;

TEST(MeanOf, HasStudentsInterval) {
  const Estimate mean = mean_of(Sample{1, 2, 3, 4}).value();
  EXPECT_DOUBLE_EQ(mean.value, 2.5);
  // Three degrees of freedom: t = 3.182446; the variance is 5/3, that of the mean 5/12.
  EXPECT_NEAR(mean.interval->low, 2.5 - 2.054260, 1e-6);
  EXPECT_NEAR(mean.interval->high, 2.5 + 2.054260, 1e-6);
}

TEST(MeanOf, HasNoIntervalForOneValueAndNothingForNone) {
  EXPECT_EQ(mean_of(Sample{7})->value, 7.0);
  EXPECT_FALSE(mean_of(Sample{7})->interval);
  EXPECT_FALSE(mean_of({}));
}

TEST(RatioOfMeans, HasFiellersInterval) {
  const Estimate ratio = ratio_of_means(Sample{12, 11, 13}, Sample{9, 10, 11}).value();
  EXPECT_DOUBLE_EQ(ratio.value, 1.2);
  // Means 12 and 10, variances 1, covariance 1/2; t^2 / n = 4.302653^2 / 3 = 6.170940:
  // (100 - 6.170940) rho^2 - 2 (120 - 3.085470) rho + (144 - 6.170940) = 0.
  EXPECT_NEAR(ratio.interval->low, 0.956777, 1e-6);
  EXPECT_NEAR(ratio.interval->high, 1.535298, 1e-6);
}

TEST(RatioOfMeans, ProportionalPairsLeaveNoDoubt) {
  const Estimate ratio = ratio_of_means(Sample{20, 22, 24}, Sample{10, 11, 12}).value();
  EXPECT_NEAR(ratio.interval->low, 2.0, 1e-7);
  EXPECT_NEAR(ratio.interval->high, 2.0, 1e-7);
}

TEST(RatioOfMeans, IsUnboundedWhereTheDenominatorMayBeZero) {
  EXPECT_FALSE(ratio_of_means(Sample{2, 4, 6}, Sample{1, 2, 3})->interval);
  EXPECT_FALSE(ratio_of_means(Sample{2}, Sample{1})->interval);
  EXPECT_EQ(ratio_of_means(Sample{2}, Sample{1})->value, 2.0);
  EXPECT_FALSE(ratio_of_means(Sample{1, 2}, Sample{0, 0}));
  EXPECT_FALSE(ratio_of_means({}, {}));
}

TEST(SlopeOf, HasStudentsInterval) {
  const Estimate slope = slope_of(Sample{0, 1, 2, 3}, Sample{1, 2, 2, 4}).value();
  // S_xx = 5, S_xy = 4.5; residuals 0.1, 0.2, -0.7, 0.4 give 0.7; t with two degrees of freedom is 4.302653:
  // t sqrt(0.7 / 2 / 5) = 1.138375.
  EXPECT_DOUBLE_EQ(slope.value, 0.9);
  EXPECT_NEAR(slope.interval->low, 0.9 - 1.138375, 1e-6);
  EXPECT_NEAR(slope.interval->high, 0.9 + 1.138375, 1e-6);
}

TEST(SlopeOf, HasNoIntervalForTwoPointsAndNothingWithoutALine) {
  EXPECT_EQ(slope_of(Sample{1, 3}, Sample{2, 8})->value, 3.0);
  EXPECT_FALSE(slope_of(Sample{1, 3}, Sample{2, 8})->interval);
  EXPECT_FALSE(slope_of(Sample{1, 1}, Sample{2, 8}));
  EXPECT_FALSE(slope_of(Sample{1}, Sample{2}));
}

bool holds(const std::optional<Estimate>& estimate, double truth) {
  return estimate && estimate->interval && estimate->interval->low <= truth &&
         truth <= estimate->interval->high;
}

TEST(Intervals, HoldTheTruthNineteenTimesOutOfTwenty) {
  constexpr int trials = 4000;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  int means = 0;
  int ratios = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Sample numerators;
    Sample denominators;
    for (int i = 0; i < 8; ++i) {
      const double shared = normal(random);
      denominators.push_back(10 + shared + normal(random));
      numerators.push_back(15 + 2 * shared + normal(random));
    }
    means += holds(mean_of(numerators), 15.0) ? 1 : 0;
    ratios += holds(ratio_of_means(numerators, denominators), 1.5) ? 1 : 0;
  }
  // Three standard deviations of the binomial distribution.
  const double slack = 3 * std::sqrt(trials * 0.95 * 0.05);
  EXPECT_NEAR(means, 0.95 * trials, slack);
  EXPECT_NEAR(ratios, 0.95 * trials, slack);
}

TEST(MedianOf, IsTheMiddle) {
  EXPECT_EQ(median_of({3, 1, 2}), 2.0);
  EXPECT_EQ(median_of({4, 1, 2, 3}), 2.5);
  EXPECT_FALSE(median_of({}));
}

}  // namespace
}  // namespace harness
