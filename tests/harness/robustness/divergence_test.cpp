// The running test of innovations gives no alarm for consistent filters, and an early one for wrong filters.
#include "harness/statistics/divergence.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "allocation_counter.hpp"

namespace harness {
namespace {

/// Draws v' S^-1 v of a filter whose innovations are `factor` times as large as it believes.
double drawn(std::mt19937_64& random, int degrees, double factor) {
  return factor * factor * std::chi_squared_distribution<double>(degrees)(random);
}

// Quantiles of the chi-square distribution, computed with Boost. For few degrees of freedom the approximation
// is on the safe side.
TEST(Divergence, TheBoundIsTheChiSquareQuantile) {
  const std::map<int, double> quantiles = {
      {2, 41.4465}, {10, 62.9455}, {20, 83.4791}, {40, 118.6825}, {400, 593.5935}};  // at 1 - 1e-9
  for (const auto& [degrees, quantile] : quantiles) {
    const double exact = tolerated_sigma * tolerated_sigma * quantile / degrees;
    EXPECT_GE(highest_nis(degrees), exact) << degrees;
    if (degrees < 20) continue;
    EXPECT_LE(highest_nis(degrees), 1.025 * exact) << degrees;
  }
  EXPECT_NEAR(highest_nees_pose(), 30.6648 / 3, 0.01);  // three degrees of freedom, at 1 - 1e-6
}

TEST(Divergence, AFilterAsWrongAsIsToleratedNeverFires) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> seen(1, 12);
  for (const double factor : {1.0, tolerated_sigma}) {
    InnovationTest test;
    for (int scan = 0; scan < 200'000; ++scan) {
      const int degrees = 2 * seen(random);
      test.add(0.2 * scan, drawn(random, degrees, factor), degrees, 0);
    }
    EXPECT_FALSE(test.fired_t()) << factor;
    EXPECT_GT(*test.worst(), 1.2 * factor * factor) << factor;
  }
}

TEST(Divergence, AFilterThatIsMuchWorseThanIsToleratedFiresWithinAWindow) {
  std::mt19937_64 random(7);
  InnovationTest test;
  for (int scan = 0; scan < 100; ++scan)
    test.add(0.2 * scan, drawn(random, 10, scan < 50 ? 1.0 : 2.0 * tolerated_sigma), 10, 0);
  ASSERT_TRUE(test.fired_t());
  EXPECT_GT(*test.fired_t(), 10.0);
  EXPECT_LT(*test.fired_t(), 12.0);
}

TEST(Divergence, WhatIsNoNumberFires) {
  InnovationTest test;
  for (int scan = 0; scan < 10; ++scan) test.add(scan, scan == 5 ? std::nan("") : 10.0, 10, 0);
  EXPECT_TRUE(test.fired_t());
}

// A single misread landmark that the gate rejects is no divergence; a gate that rejects almost everything is.
TEST(Divergence, AGateThatShutsTheWorldOutFires) {
  std::mt19937_64 random(7);
  InnovationTest one;
  InnovationTest all;
  for (int scan = 0; scan < 40; ++scan) {
    one.add(scan, drawn(random, 10, 1.0), 10, scan % 2);
    all.add(scan, scan < 20 ? drawn(random, 10, 1.0) : 0.0, scan < 20 ? 10 : 0, scan < 20 ? 0 : 5);
  }
  EXPECT_FALSE(one.fired_t());
  ASSERT_TRUE(all.fired_t());
  EXPECT_LE(*all.fired_t(), 26.0);
}

TEST(Divergence, ScansThatSawNothingKnownDoNotCount) {
  InnovationTest test;
  for (int scan = 0; scan < 9; ++scan) test.add(scan, 1e6, 10, 0);  // one too few for a window
  for (int scan = 9; scan < 1000; ++scan) test.add(scan, 0.0, 0, 0);
  EXPECT_FALSE(test.fired_t());
  test.add(1000, 10.0, 10, 0);
  EXPECT_EQ(test.fired_t(), 1000.0);
}

TEST(Divergence, AllocatesNothing) {
  if (COUNTS_ALLOCATIONS == 0) GTEST_SKIP() << "the sanitizer has a malloc of its own";
  InnovationTest test;
  const long before = allocations();
  for (int scan = 0; scan < 1000; ++scan) test.add(scan, 10.0, 10, 0);
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace harness
