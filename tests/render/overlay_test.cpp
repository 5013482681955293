// The overlay, checked to the pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "pictures.hpp"
#include "sim/render/renderer.hpp"

namespace render {
namespace {

using namespace test;
constexpr int width = 200;
constexpr int height = 100;

Image drawn_items(const std::vector<OverlayItem>& items) {
  Scene scene;
  scene.sky = white;
  scene.overlay = items;
  return drawn(scene, width, height);
}

struct Extent {
  int left = width;
  int right = -1;
  int top = height;
  int bottom = -1;
};

Extent extent(const Image& image) {
  Extent extent;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (darkness(image, x, y) < 0.1) continue;
      extent.left = std::min(extent.left, x);
      extent.right = std::max(extent.right, x);
      extent.top = std::min(extent.top, y);
      extent.bottom = std::max(extent.bottom, y);
    }
  }
  return extent;
}

Text text(const std::string& words, Align align = Align::left) {
  Text text;
  text.position = {100.0F, 50.0F};
  text.size = 20.0F;
  text.align = align;
  text.text = words;
  return text;
}

TEST(Rectangle, FillsItsPixelsAndShareOfThoseOnItsEdge) {
  const Image image = drawn_items({Rectangle{{10.0F, 20.0F}, {30.5F, 40.0F}, black}});
  EXPECT_NEAR(ink(image), 20.5 * 20.0, 0.5);
  const Extent box = extent(image);
  EXPECT_EQ(box.left, 10);
  EXPECT_EQ(box.right, 30);
  EXPECT_EQ(box.top, 20);
  EXPECT_EQ(box.bottom, 39);
  EXPECT_NEAR(darkness(image, 30, 30), 0.5, 0.01);
}

TEST(Text, IsAsWideAsSaid) {
  // The letter begins and ends with a stem, with only a little space beside it.
  const Extent box = extent(drawn_items({text("HHHHHH")}));
  const float wide = text_width("HHHHHH", 20.0F, Weight::regular);
  EXPECT_NEAR(box.left, 100.0, 3.0);
  EXPECT_NEAR(box.right + 1.0, 100.0 + static_cast<double>(wide), 3.0);
  EXPECT_NEAR(box.bottom, 49.0, 1.0);                          // the baseline
  EXPECT_NEAR(box.bottom - box.top + 1.0, 0.711 * 20.0, 1.0);  // Roboto's capitals
}

TEST(Text, IsAlignedAtItsPosition) {
  const double wide = static_cast<double>(text_width("HHH", 20.0F, Weight::regular));
  const int left = extent(drawn_items({text("HHH", Align::left)})).left;
  EXPECT_NEAR(extent(drawn_items({text("HHH", Align::centre)})).left, left - 0.5 * wide, 1.0);
  EXPECT_NEAR(extent(drawn_items({text("HHH", Align::right)})).left, left - wide, 1.0);
}

TEST(Text, HasDigitsOfOneWidth) {
  for (const Weight weight : {Weight::regular, Weight::bold}) {
    const float one = text_width("1", 14.0F, weight);
    for (const char* digit : {"0", "2", "3", "4", "5", "6", "7", "8", "9"})
      EXPECT_EQ(text_width(digit, 14.0F, weight), one) << digit;
  }
}

TEST(Text, HasTheSignsOfTheField) {
  const Image missing = drawn_items({text("\uE000")});  // a character that no font has
  EXPECT_GT(ink(missing), 10.0);                        // shows as a box
  for (const char* sign :
       {"µ", "×", "·", "²", "σ", "±", "–", "Σ", "Ω", "ξ", "θ", "δ", "°", "√", "≤", "≥", "−"}) {
    const Image image = drawn_items({text(sign)});
    EXPECT_GT(ink(image), 2.0) << sign;
    EXPECT_GT(difference(image, missing).mean, 0.05) << sign;
  }
}

TEST(Text, OfBrokenUtf8IsDrawnNonetheless) {
  EXPECT_GT(ink(drawn_items({text("a\xC3")})), ink(drawn_items({text("a")})));
  EXPECT_GT(ink(drawn_items({text("\xFF"
                                  "b")})),
            ink(drawn_items({text("b")})));
}

TEST(Polyline, CoversItsLengthTimesItsWidthOnceOnly) {
  Polyline line;
  line.width = 6.0F;
  line.colour = {0.0F, 0.0F, 0.0F, 0.5F};
  line.points = {{20.0F, 20.0F}, {90.0F, 70.0F}, {160.0F, 30.0F}};
  const Image image = drawn_items({line});
  double darkest = 0.0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) darkest = std::max(darkest, darkness(image, x, y));
  }
  EXPECT_NEAR(darkest, 0.5, 0.01);  // no joint is painted twice
  const double length = std::hypot(70.0, 50.0) + std::hypot(70.0, 40.0);
  EXPECT_NEAR(ink(image), 0.5 * (6.0 * length + 28.0), 10.0);
}

TEST(Polyline, OfManyPointsIsTheSameAsOfFew) {
  Polyline few;
  few.points = {{20.0F, 20.0F}, {180.0F, 60.0F}};
  Polyline many;
  for (int i = 0; i <= 1000; ++i)
    many.points.emplace_back(20.0F + 0.16F * static_cast<float>(i), 20.0F + 0.04F * static_cast<float>(i));
  EXPECT_LT(difference(drawn_items({few}), drawn_items({many})).mean, 0.2);
}

TEST(Band, FillsWhatLiesBetween) {
  Band band;
  band.colour = {0.0F, 0.0F, 0.0F, 0.6F};
  for (int i = 0; i <= 300; ++i) {
    const float x = 20.0F + 0.5F * static_cast<float>(i);
    band.points.emplace_back(x, 40.0F, 60.25F);
  }
  const Image image = drawn_items({band});
  EXPECT_NEAR(ink(image), 0.6 * 150.0 * 20.25, 5.0);
  for (int x = 22; x < 168; ++x) EXPECT_NEAR(darkness(image, x, 50), 0.6, 0.01) << x;  // no seams
}

TEST(Raster, HasSharpCellsFromTheTop) {
  Raster raster;
  raster.min = {20.0F, 20.0F};
  raster.max = {60.0F, 40.0F};
  raster.columns = 4;
  raster.rows = 2;
  for (int i = 0; i < 8; ++i) {
    const auto value = static_cast<std::uint8_t>(30 * i);
    raster.rgba.insert(raster.rgba.end(), {value, value, value, 255});
  }
  const Image image = drawn_items({raster});
  for (int y = 20; y < 40; ++y) {
    for (int x = 20; x < 60; ++x) EXPECT_EQ(image.pixel(x, y)[1], 30 * (4 * ((y - 20) / 10) + (x - 20) / 10));
  }
  EXPECT_EQ(image.pixel(60, 30)[1], 255);
}

TEST(Overlay, IsPaintedInItsOrder) {
  const Colour red = {1.0F, 0.0F, 0.0F};
  const Polyline line = {{{0.0F, 50.0F}, {200.0F, 50.0F}}, 10.0F, black};
  const Rectangle box = {{80.0F, 30.0F}, {120.0F, 70.0F}, red};
  EXPECT_EQ(drawn_items({line, box}).pixel(100, 50)[0], 255);
  EXPECT_EQ(drawn_items({box, line}).pixel(100, 50)[0], 0);
  EXPECT_EQ(drawn_items({box, line, box}).pixel(100, 50)[0], 255);
}

}  // namespace
}  // namespace render
