#include "harness/statistics/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <utility>
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

TEST(MeanOfPositive, IsNeverBelowZero) {
  const Sample errors = {0.01, 0.02, 0.02, 0.03, 0.05, 0.08, 0.1, 90.0};  // one run that diverged
  ASSERT_LT(mean_of(errors)->interval->low, 0.0) << "Student's interval is";
  const Estimate mean = mean_of_positive(errors).value();
  EXPECT_EQ(mean.value, mean_of(errors)->value);
  EXPECT_GT(mean.interval->low, 0.0);
  EXPECT_LT(mean.interval->low, mean.value);
  EXPECT_GT(mean.interval->high, mean.value);
  EXPECT_LE(mean.interval->high, 90.0);
  const ConfidenceInterval again = *mean_of_positive(errors)->interval;
  EXPECT_EQ(again.low, mean.interval->low) << "equal samples, equal bits";
  EXPECT_EQ(again.high, mean.interval->high);
}

TEST(MeanOfPositive, HasStudentsIntervalOfTheLogarithmForAFewValues) {
  // The standard error of MeanOf.HasStudentsInterval, 2.054260 / 2.5 of the mean.
  const Estimate mean = mean_of_positive(Sample{1, 2, 3, 4}).value();
  EXPECT_DOUBLE_EQ(mean.value, 2.5);
  EXPECT_NEAR(mean.interval->low, 2.5 * std::exp(-2.054260 / 2.5), 1e-6);
  EXPECT_NEAR(mean.interval->high, 2.5 * std::exp(2.054260 / 2.5), 1e-6);
}

TEST(MeanOfPositive, KnowsTheEdges) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(mean_of_positive({}));
  EXPECT_EQ(mean_of_positive(Sample{7})->value, 7.0);
  EXPECT_FALSE(mean_of_positive(Sample{7, 8})->interval) << "two values say too little";
  for (const std::size_t count : {3U, 20U}) {
    const Estimate zero = mean_of_positive(Sample(count, 0.0)).value();
    EXPECT_EQ(zero.value, 0.0);
    EXPECT_EQ(zero.interval->low, 0.0);
    EXPECT_EQ(zero.interval->high, 0.0);
    const Estimate equal = mean_of_positive(Sample(count, 0.1)).value();
    EXPECT_EQ(equal.interval->low, 0.1);
    EXPECT_EQ(equal.interval->high, 0.1);
    Sample diverged(count, 1.0);
    diverged.back() = infinity;
    EXPECT_EQ(mean_of_positive(diverged)->value, infinity);
    EXPECT_FALSE(mean_of_positive(diverged)->interval);
    Sample some_zeros(count, 0.0);
    some_zeros.back() = 1.0;
    EXPECT_GE(mean_of_positive(some_zeros)->interval->low, 0.0);
  }
  EXPECT_LT(mean_of_positive(Sample{-1, 0, 1})->interval->low, -1.0) << "signed values: Student's";
}

TEST(RatioOfPairs, IsTheGeometricMeanWithTheIntervalOfItsLogarithm) {
  const Estimate ratio = ratio_of_pairs(Sample{2, 40, 8}, Sample{2, 10, 0.5}).value();  // 1, 4, 16
  EXPECT_DOUBLE_EQ(ratio.value, 4.0);
  // The logarithms have the standard deviation log 4.
  const double half = 4.302653 * std::log(4.0) / std::sqrt(3.0);
  EXPECT_NEAR(ratio.interval->low, 4.0 * std::exp(-half), 1e-5);
  EXPECT_NEAR(ratio.interval->high, 4.0 * std::exp(half), 1e-3);
  EXPECT_GT(ratio.interval->low, 0.0);
}

TEST(RatioOfPairs, KnowsTheEdges) {
  EXPECT_FALSE(ratio_of_pairs({}, {}));
  EXPECT_EQ(ratio_of_pairs(Sample{2}, Sample{1})->value, 2.0);
  EXPECT_FALSE(ratio_of_pairs(Sample{2, 3}, Sample{1, 1})->interval);
  EXPECT_EQ(ratio_of_pairs(Sample{1, 2, 3}, Sample{1, 2, 3})->interval->high, 1.0);
  EXPECT_FALSE(ratio_of_pairs(Sample{1, 0, 3}, Sample{1, 2, 3})) << "zero has no logarithm";
  EXPECT_FALSE(ratio_of_pairs(Sample{1, 2, 3}, Sample{1, 0, 3}));
  EXPECT_FALSE(ratio_of_pairs(Sample{0, 0, 0}, Sample{0, 0, 0}));
  EXPECT_FALSE(ratio_of_pairs(Sample{std::numeric_limits<double>::infinity(), 2}, Sample{1, 2}));
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

TEST(RatioOfMeans, HasNoIntervalThatReachesBelowZero) {
  const Sample baseline = {1.0, 1.1, 0.9, 1.0, 1.05, 0.95};
  const Estimate ratio = ratio_of_means(Sample{1, 1, 1, 1, 1, 200}, baseline).value();
  EXPECT_NEAR(ratio.value, 205.0 / 6.0, 1e-9);
  EXPECT_FALSE(ratio.interval);
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

/// The squared errors of runs are as skewed as these: exp of normal values, with mean exp(1/2), median 1.
TEST(Intervals, OfSkewedPositiveValuesHoldTheMeanNearlyAsOften) {
  constexpr int trials = 400;
  for (const auto& [count, least] : {std::pair(5, 0.85), std::pair(20, 0.87), std::pair(100, 0.9)}) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    int held = 0;
    for (int trial = 0; trial < trials; ++trial) {
      Sample sample;
      for (int i = 0; i < count; ++i) sample.push_back(std::exp(normal(random)));
      const std::optional<Estimate> mean = mean_of_positive(sample);
      held += holds(mean, std::exp(0.5)) ? 1 : 0;
      EXPECT_GT(mean->interval->low, 0.0);
    }
    EXPECT_GT(held, least * trials) << count;
    EXPECT_LT(held, 0.97 * trials) << count;
  }
}

TEST(MedianOf, IsTheMiddle) {
  EXPECT_EQ(median_of({3, 1, 2}), 2.0);
  EXPECT_EQ(median_of({4, 1, 2, 3}), 2.5);
  EXPECT_FALSE(median_of({}));
}

}  // namespace
}  // namespace harness
