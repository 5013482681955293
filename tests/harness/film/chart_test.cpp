#include "harness/film/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <variant>
#include <vector>

#include "harness/film/paint.hpp"

namespace harness {
namespace {

using Overlay = std::vector<render::OverlayItem>;

bool same_colour(const render::Colour& a, const render::Colour& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

template <class Item>
std::vector<Item> items_of(const Overlay& overlay, Rgb colour) {
  std::vector<Item> items;
  for (const render::OverlayItem& item : overlay) {
    const Item* const found = std::get_if<Item>(&item);
    if (found != nullptr && same_colour(found->colour, paint(colour))) items.push_back(*found);
  }
  return items;
}

TEST(Chart, DrawsBandsThatLieOnEachOtherInTwoWays) {
  Series values(0.0, 10.0, 100);
  Series band(0.0, 10.0, 100);
  for (double t = 0.05; t < 10.0; t += 0.1) {
    values.add(t, 0.1);
    band.add(t, 0.5 + 0.04 * t);
  }
  Chart chart{{0, 0, 300, 150}, "error", "m", 2, Scale::linear, {}};
  chart.curves.push_back({"first", palette::green, &values, &band});
  chart.curves.push_back({"second", palette::blue, &values, &band});
  Overlay overlay;
  append_chart(chart, 1.0F, overlay);
  EXPECT_EQ(items_of<render::Band>(overlay, palette::green).size(), 1U);
  EXPECT_TRUE(items_of<render::Band>(overlay, palette::blue).empty());
  EXPECT_EQ(items_of<render::Polyline>(overlay, palette::green).size(), 1U) << "the curve alone";
  EXPECT_GT(items_of<render::Polyline>(overlay, palette::blue).size(), 20U) << "and dashes";
}

TEST(Dashes, HaveTheirLengthsAlongALineWithCorners) {
  Overlay overlay;
  append_dashes({{0, 0}, {7, 0}, {7, 20}}, {1.0F, 5.0F, 3.0F, paint(palette::blue)}, overlay);
  ASSERT_EQ(overlay.size(), 4U);  // 0 to 5, 8 to 13, 16 to 21, 24 to 27
  const auto dash = [&](std::size_t i) { return std::get<render::Polyline>(overlay[i]).points; };
  EXPECT_EQ(dash(0).back(), Eigen::Vector2f(5, 0));
  EXPECT_EQ(dash(1).front(), Eigen::Vector2f(7, 1));
  EXPECT_EQ(dash(1).back(), Eigen::Vector2f(7, 6));
  EXPECT_EQ(dash(3).back(), Eigen::Vector2f(7, 20));
}

TEST(Dashes, OfAPointAreNone) {
  Overlay overlay;
  append_dashes({{1, 1}}, {1.0F, 5.0F, 3.0F, {}}, overlay);
  append_dashes({{1, 1}, {1, 1}}, {1.0F, 5.0F, 3.0F, {}}, overlay);
  EXPECT_TRUE(overlay.empty());
}

}  // namespace
}  // namespace harness
