#include "harness/film/series.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

namespace harness {
namespace {

TEST(Series, GivesTheMedianOfEachInterval) {
  Series series(0.0, 10.0, 5);
  for (const double value : {5.0, 1.0, 100.0}) series.add(1.0, value);
  EXPECT_EQ(series.value(0), 5.0);
  EXPECT_EQ(series.value(1), std::nullopt);
  EXPECT_DOUBLE_EQ(series.time_of(0), 1.0);
  EXPECT_DOUBLE_EQ(series.time_of(4), 9.0);
}

TEST(Series, PutsTheEndsIntoTheFirstAndLastInterval) {
  Series series(2.0, 4.0, 4);
  series.add(2.0, 1.0);
  series.add(4.0, 2.0);
  EXPECT_EQ(series.value(0), 1.0);
  EXPECT_EQ(series.value(3), 2.0);
}

TEST(Series, KnowsItsExtremesWithoutOutliersAndItsLastValue) {
  Series series(0.0, 1.0, 2);
  EXPECT_EQ(series.last(), std::nullopt);
  EXPECT_EQ(series.largest(), std::nullopt);
  for (const double value : {3.0, 900.0, 4.0}) series.add(0.1, value);
  series.add(0.9, 2.0);
  EXPECT_EQ(series.smallest(), 2.0);
  EXPECT_EQ(series.largest(), 4.0);
  EXPECT_EQ(series.last(), 2.0);
}

TEST(Series, LeavesOutWhatIsNotFinite) {
  Series series(0.0, 1.0, 1);
  series.add(0.5, std::numeric_limits<double>::quiet_NaN());
  series.add(0.5, std::numeric_limits<double>::infinity());
  EXPECT_EQ(series.value(0), std::nullopt);
  EXPECT_EQ(series.last(), std::nullopt);
}

}  // namespace
}  // namespace harness
