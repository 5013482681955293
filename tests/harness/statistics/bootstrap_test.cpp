#include "harness/statistics/bootstrap.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace harness {
namespace {

constexpr double normal_90 = 1.6448536269514722;
constexpr double normal_95 = 1.959963984540054;

/// The spatial test data of Efron and Tibshirani (1993), chapter 14.
TEST(BcaLevels, AreThoseOfEfronsSpatialTestData) {
  const BcaLevels levels = bca_levels(0.146, 0.061, normal_90);
  EXPECT_NEAR(levels.low, 0.110, 5e-4);
  EXPECT_NEAR(levels.high, 0.985, 1e-3);
}

TEST(BcaLevels, AreTheNormalOnesWithoutBiasAndSkewness) {
  EXPECT_NEAR(bca_levels(0.0, 0.0, normal_95).low, 0.025, 1e-12);
  EXPECT_NEAR(bca_levels(0.0, 0.0, normal_95).high, 0.975, 1e-12);
}

TEST(BcaLevels, EndAtNothingAndAllWhereTheFormulaHasItsPole) {
  EXPECT_EQ(bca_levels(2.0, 0.5, normal_95).high, 1.0);
  EXPECT_EQ(bca_levels(-2.0, -0.5, normal_95).low, 0.0);
}

/// Efron's mouse data: the survival in days of treated mice and of the others. The ends expected are those of the
/// ideal bootstrap: of all 7^7 and 9^9 resamples.
TEST(BcaInterval, IsTheIdealBootstrapsForEfronsMice) {
  const std::vector<double> treated = {94, 197, 16, 38, 99, 141, 23};
  const ConfidenceInterval of_treated = bca_interval_of_mean(treated, normal_90);
  EXPECT_NEAR(of_treated.low, 52.286, 1.5);
  EXPECT_NEAR(of_treated.high, 130.143, 1.5);
  const std::vector<double> others = {52, 104, 146, 10, 51, 30, 40, 27, 46};
  const ConfidenceInterval of_others = bca_interval_of_mean(others, normal_95);
  EXPECT_NEAR(of_others.low, 36.111, 1.5);
  EXPECT_NEAR(of_others.high, 91.889, 1.5);
}

TEST(BcaInterval, ScalesWithItsValues) {
  const std::vector<double> sample = {1, 2, 3, 5, 8, 13, 21, 34};
  const ConfidenceInterval interval = bca_interval_of_mean(sample, normal_95);
  for (const double unit : {1e-200, 1e200}) {
    std::vector<double> scaled = sample;
    for (double& value : scaled) value *= unit;
    const ConfidenceInterval of_scaled = bca_interval_of_mean(scaled, normal_95);
    EXPECT_NEAR(of_scaled.low / unit, interval.low, 1e-9);
    EXPECT_NEAR(of_scaled.high / unit, interval.high, 1e-9);
  }
}

}  // namespace
}  // namespace harness
