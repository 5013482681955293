#include "harness/film/layout.hpp"

#include <gtest/gtest.h>

namespace harness {
namespace {

TEST(Layout, LeavesNoHoleForAFilterWithoutAMatrix) {
  const worlds::Film film;
  const Layout both = layout_of(film, {true, true});
  const Layout second = layout_of(film, {false, true});
  const Layout none = layout_of(film, {false, false});
  ASSERT_EQ(second.matrices.size(), 2U);
  EXPECT_FALSE(second.matrices[0]);
  ASSERT_TRUE(second.matrices[1] && both.matrices[0] && both.matrices[1]);
  EXPECT_EQ(second.matrices[1]->x, both.matrices[0]->x);
  EXPECT_EQ(second.times->x, both.matrices[1]->x) << "the chart begins where the other matrix was";
  EXPECT_EQ(none.times->x, 0.0F);
  for (const Layout& layout : {both, second, none}) {
    EXPECT_FLOAT_EQ(layout.times->x + layout.times->width, layout.pose_error->x);
    EXPECT_FLOAT_EQ(layout.pose_error->x + layout.pose_error->width, layout.legend->x);
    EXPECT_EQ(layout.views.size(), 2U);
  }
}

TEST(Layout, HasNoPanelForMatricesThatAreNotKept) {
  worlds::Film film;
  film.layers.times = film.layers.pose_error = film.layers.legend = false;
  EXPECT_TRUE(layout_of(film, {true}).panel);
  EXPECT_FALSE(layout_of(film, {false}).panel);
  EXPECT_FALSE(layout_of(film, {}).panel);
}

}  // namespace
}  // namespace harness
