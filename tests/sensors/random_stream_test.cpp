#include "sensors/random_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace sensors {
namespace {

TEST(RandomStream, IsEqualForEqualSeedAndName) {
  EXPECT_EQ(random_stream(7, "encoders"), random_stream(7, "encoders"));
}

TEST(RandomStream, DiffersForAnotherSeedOrName) {
  EXPECT_NE(random_stream(7, "encoders"), random_stream(8, "encoders"));
  EXPECT_NE(random_stream(7, "encoders"), random_stream(7, "landmark_sensor"));
  EXPECT_NE(random_stream(7, "a"), random_stream(7, ""));
  EXPECT_NE(random_stream(7, ""), random_stream(7 + (std::uint64_t{1} << 32U), ""));
}

// Fixes the mapping itself, so that a run with an old seed stays the same run. The hash of "a" is FNV-1a's
// published vector 0xaf63dc4c8601ec8c, so the words of the seed sequence can be written out.
TEST(RandomStream, SeedsTheEngineWithSeedAndHashOfTheName) {
  std::seed_seq words{5U, 1U, 0x8601ec8cU, 0xaf63dc4cU};
  EXPECT_EQ(random_stream((std::uint64_t{1} << 32U) + 5, "a"), std::mt19937_64(words));
}

// The sample correlation of n independent pairs has standard deviation 1 / sqrt(n): five of them are allowed.
TEST(RandomStream, StreamsOfNeighbouringSeedsAndNamesAreUncorrelated) {
  constexpr int n = 40000;
  const auto correlation = [](std::mt19937_64 a, std::mt19937_64 b) {
    std::uniform_real_distribution<double> uniform(-std::sqrt(3.0), std::sqrt(3.0));  // unit variance
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      sum += uniform(a) * uniform(b);
    }
    return sum / n;
  };
  const double bound = 5.0 / std::sqrt(n);
  EXPECT_LT(std::abs(correlation(random_stream(1, "encoders"), random_stream(2, "encoders"))), bound);
  EXPECT_LT(std::abs(correlation(random_stream(1, "encoders"), random_stream(1, "landmarks"))), bound);
  EXPECT_GT(std::abs(correlation(random_stream(1, "encoders"), random_stream(1, "encoders"))), 0.9);
}

}  // namespace
}  // namespace sensors
