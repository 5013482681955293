// Where the surroundings of the robot are, as seen from where they joined the map.
#include "seif/tree/homes.hpp"

#include <gtest/gtest.h>

namespace seif {
namespace {

constexpr double far = 3.0;  // [m]

TEST(Homes, TakesTheMedian) {
  Homes homes;
  homes.begin();
  for (const double x : {1.0, 1.1, 0.9, 2.0, 1.0}) homes.add({x, 0.0}, {0.0, 5.0});
  homes.finish(far);
  EXPECT_DOUBLE_EQ(homes.offset().x(), 1.0);
  EXPECT_DOUBLE_EQ(homes.offset().y(), -5.0);
  EXPECT_FALSE(homes.other_offset());
}

TEST(Homes, KnowsTheOtherSideOfASeam) {
  Homes homes;
  homes.begin();
  for (int i = 0; i < 4; ++i) homes.add({0.0, 0.0}, {0.0, 0.0});
  homes.add({40.0, 0.0}, {1.0, 0.0});
  homes.finish(far);
  EXPECT_DOUBLE_EQ(homes.offset().x(), 0.0);
  ASSERT_TRUE(homes.other_offset());
  EXPECT_DOUBLE_EQ(homes.other_offset()->x(), 39.0);
}

TEST(Homes, StayWhereNoLandmarkIsInView) {
  Homes homes;
  homes.begin();
  homes.add({2.0, 0.0}, {0.0, 0.0});
  homes.finish(far);
  homes.begin();
  homes.finish(far);
  EXPECT_DOUBLE_EQ(homes.offset().x(), 2.0);
}

}  // namespace
}  // namespace seif
