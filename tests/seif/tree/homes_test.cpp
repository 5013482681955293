// Where the surroundings of the robot are, as seen from where they joined the map.
#include "seif/tree/homes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace seif {
namespace {

constexpr double far = 3.0;  // [m]

TEST(Homes, TakesTheOffsetInTheMiddle) {
  Homes homes;
  homes.begin();
  for (const double x : {1.0, 1.1, 0.9, 2.0, 1.0}) homes.add({x, 0.0}, {0.0, 5.0});
  homes.finish(far);
  EXPECT_DOUBLE_EQ(homes.offset().x(), 1.0);
  EXPECT_DOUBLE_EQ(homes.offset().y(), -5.0);
  EXPECT_FALSE(homes.other_offset());
}

TEST(Homes, TheOffsetTurnsWithTheFrameOfTheWorld) {
  const std::vector<Eigen::Vector2d> homes = {{1, 2}, {4, -3}, {-2, 5}, {7, 1}, {3, 3}, {-6, -1}};
  const std::vector<Eigen::Vector2d> means = {{0, 2.3}, {2.2, -4}, {-3.1, 4}, {6.9, -1}, {0.5, 2}, {-9, 0}};
  for (const double angle : {0.0, 0.4, 1.5, -2.3}) {
    const Eigen::Rotation2Dd R(angle);
    Homes still, turned;
    still.begin();
    turned.begin();
    for (std::size_t i = 0; i < homes.size(); ++i) {
      still.add(homes[i], means[i]);
      turned.add(R * homes[i], R * means[i]);
    }
    still.finish(far);
    turned.finish(far);
    EXPECT_LT((turned.offset() - R * still.offset()).norm(), 1e-12) << angle;
  }
}

TEST(Homes, AmongEqualsTakesTheFirst) {
  Homes homes;
  homes.begin();
  for (const double x : {2.0, 1.0}) homes.add({x, 0.0}, {0.0, 0.0});
  homes.finish(far);
  EXPECT_EQ(homes.offset().x(), 2.0);
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
