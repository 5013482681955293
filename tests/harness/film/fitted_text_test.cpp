#include "harness/film/fitted_text.hpp"

#include <gtest/gtest.h>

#include <string>

#include "sim/render/renderer.hpp"

namespace harness {
namespace {

constexpr render::Weight regular = render::Weight::regular;

TEST(FittedText, IsTheTextWhereThereIsRoom) { EXPECT_EQ(fitted("seif", 14.0F, regular, 100.0F), "seif"); }

TEST(FittedText, KeepsToTheRoomAndSaysThatSomethingIsMissing) {
  const std::string text = "a rather long name";
  for (float room = 20.0F; room < 100.0F; room += 7.0F) {
    const std::string result = fitted(text, 14.0F, regular, room);
    EXPECT_LE(render::text_width(result, 14.0F, regular), room);
    EXPECT_TRUE(result.ends_with("\u2026")) << result;
    EXPECT_TRUE(text.starts_with(result.substr(0, result.size() - 3))) << result;
  }
}

TEST(FittedText, CutsBetweenCharacters) {
  const std::string text = "\u00b5\u00b5\u00b5\u00b5\u00b5\u00b5";
  const float room = render::text_width("\u00b5\u00b5\u00b5\u2026", 14.0F, regular);
  EXPECT_EQ(fitted(text, 14.0F, regular, room + 0.01F), "\u00b5\u00b5\u00b5\u2026");
}

TEST(FittedText, IsNothingWhereThereIsNoRoom) { EXPECT_EQ(fitted("seif", 14.0F, regular, 1.0F), ""); }

}  // namespace
}  // namespace harness
