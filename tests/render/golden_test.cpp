// Compares small scenes with images that a person has checked. SEIFBED_UPDATE_GOLDEN=1 draws new ones: check
// them again.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "pictures.hpp"
#include "scenes.hpp"
#include "sim/render/png.hpp"
#include "sim/render/renderer.hpp"

namespace render {
namespace {

using namespace test;
constexpr int width = 320;
constexpr int height = 180;
constexpr Colour red = {0.85F, 0.20F, 0.15F};

/// Another version of the library rounds differently: by single steps of 255 everywhere, and by more in the few
/// edge pixels that get another sample. A line that is missing or shifted by a pixel changes a whole per cent
/// of the pixels.
void expect_golden(const std::string& name, const Image& image) {
  const std::filesystem::path golden =
      std::filesystem::path(SEIFBED_SOURCE_DIR) / "tests/render/golden" / (name + ".png");
  if (std::getenv("SEIFBED_UPDATE_GOLDEN") != nullptr) write_png(golden, image);
  const Difference off = difference(image, read_png(golden));
  if (off.mean < 0.25 && off.share < 0.001) return;
  const std::filesystem::path actual = testing::TempDir() + "render_" + name + ".png";
  write_png(actual, image);
  ADD_FAILURE() << actual << " is not " << golden << ": off by " << off.mean << " on the average, "
                << 100.0 * off.share << " % of the pixels by more than 24";
}

Camera from_behind() {
  Camera camera;
  camera.eye = {2.0, -11.0, 6.0};
  camera.target = {0.0, 0.5, 0.0};
  return camera;
}

Solid box(const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
  Solid solid;
  solid.T_world_solid.translation() = centre;
  solid.size = size;
  solid.colour = {0.80F, 0.82F, 0.85F};
  return solid;
}

TEST(Golden, EmptyWorld) {
  Scene scene = bare(width, height, from_behind());
  scene.ground.size = {14.0, 20.0};
  expect_golden("empty_world", drawn(scene, width, height));
}

/// A box with one stroke behind it, and another stroke behind it that is visible through everything.
TEST(Golden, Occlusion) {
  Scene scene = bare(width, height, from_behind());
  scene.things.solids.push_back(box({0.0, 0.0, 0.75}, {2.0, 1.0, 1.5}));
  const Stroke hidden = {{-3.0, 1.5, 0.4}, {3.0, 1.5, 0.4}, 3.0F, red};
  const Stroke on_top = {{-3.0, 2.0, 0.0}, {3.0, 2.0, 0.0}, 3.0F, {0.1F, 0.4F, 0.8F}};
  scene.things.marks.strokes.push_back(hidden);
  scene.things.marks_on_top.strokes.push_back(on_top);
  scene.things.marks.strokes.push_back({{-1.0, 0.0, 1.5}, {1.0, 0.0, 1.5}, 3.0F, red});  // lies on the box
  const Image image = drawn(scene, width, height);
  const auto is_red = [&](const Eigen::Vector3d& p_world) {
    const Eigen::Vector2d p = projected(from_behind(), p_world, width, height);
    const std::uint8_t* pixel = image.pixel(static_cast<int>(p.x()), static_cast<int>(p.y()));
    return pixel[0] > pixel[2] + 60;
  };
  const auto is_blue = [&](const Eigen::Vector3d& p_world) {
    const Eigen::Vector2d p = projected(from_behind(), p_world, width, height);
    const std::uint8_t* pixel = image.pixel(static_cast<int>(p.x()), static_cast<int>(p.y()));
    return pixel[2] > pixel[0] + 60;
  };
  EXPECT_TRUE(is_red({-2.5, 1.5, 0.4}));
  EXPECT_FALSE(is_red({0.0, 1.5, 0.4}));
  EXPECT_TRUE(is_red({0.0, 0.0, 1.5}));
  EXPECT_TRUE(is_blue({0.0, 2.0, 0.0}));
  EXPECT_TRUE(is_blue({2.5, 2.0, 0.0}));
  expect_golden("occlusion", image);
}

TEST(Golden, Text) {
  Scene scene;
  const Colour dark = {0.15F, 0.17F, 0.2F};
  scene.overlay = {Text{{12.0F, 30.0F}, 22.0F, Align::left, Weight::bold, dark, "Sparse map"},
                   Text{{308.0F, 30.0F}, 14.0F, Align::right, Weight::regular, dark, "t = 12.34 s, 4×"},
                   Text{{160.0F, 70.0F}, 14.0F, Align::centre, Weight::regular, red, "µ ± 3σ · Σ² Ω ξ θ –"},
                   Text{{12.0F, 110.0F},
                        12.0F,
                        Align::left,
                        Weight::regular,
                        dark,
                        "The quick brown fox jumps over 0123456789"},
                   Text{{12.0F, 160.0F}, 40.0F, Align::left, Weight::regular, dark, "Qgyj (4)"}};
  expect_golden("text", drawn(scene, width, height));
}

/// The same world from two sides; an ellipse and a post are only in the right view.
TEST(Golden, SplitScreen) {
  Scene scene = bare(158, height, from_behind());
  scene.things.solids.push_back(box({0.0, 1.0, 0.5}, {1.0, 1.0, 1.0}));
  View right = scene.views[0];
  right.x = 162;
  right.camera = from_above({0.0, 0.0, 0.0}, 10.0);
  Ellipse ellipse;
  ellipse.centre = {0.5, -2.0, 0.0};
  ellipse.axes << 1.0, -0.3, 0.5, 0.4;
  ellipse.outline = red;
  ellipse.fill = {red.r, red.g, red.b, 0.25F};
  right.things.marks.ellipses.push_back(ellipse);
  right.things.posts.push_back({{-2.0, -2.0}, 0.3F, 1.0F, red});
  scene.views.push_back(right);
  const Image image = drawn(scene, width, height);
  int left_red = 0;
  int right_red = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (image.pixel(x, y)[0] > image.pixel(x, y)[2] + 30) ++(x < width / 2 ? left_red : right_red);
    }
  }
  EXPECT_EQ(left_red, 0);
  EXPECT_GT(right_red, 300);
  expect_golden("split_screen", image);
}

TEST(Golden, Shadows) {
  Camera camera = from_behind();
  camera.field_of_view = 0.4;
  Scene scene = bare(width, height, camera);
  scene.ground.grid = 0.0;
  scene.things.solids.push_back(box({0.0, 0.0, 0.5}, {1.5, 1.0, 1.0}));
  scene.things.posts.push_back({{-2.5, 0.0}, 0.2F, 1.5F, red});
  Solid wheel = box({2.5, 1.0, 0.5}, {1.0, 1.0, 0.3});
  wheel.shape = Shape::cylinder;
  wheel.T_world_solid.rotate(Eigen::AngleAxisd(1.3, Eigen::Vector3d(1.0, 0.3, 0.0).normalized()));
  scene.things.solids.push_back(wheel);
  const Image image = drawn(scene, width, height);
  const auto brightness = [&](const Image& of, const Eigen::Vector3d& p_world) {
    const Eigen::Vector2d p = projected(camera, p_world, width, height);
    return static_cast<int>(of.pixel(static_cast<int>(p.x()), static_cast<int>(p.y()))[1]);
  };
  // The sun is in the south-west, so the ground north-east of the box is darker.
  const Eigen::Vector3d shaded(0.95, 0.75, 0.0);
  const Eigen::Vector3d sunny(0.0, -1.5, 0.0);
  EXPECT_LT(brightness(image, shaded), brightness(image, sunny) - 30);
  // No lit face has dark spots from its own shadow.
  for (double x = -0.65; x < 0.66; x += 0.05)
    EXPECT_NEAR(brightness(image, {x, 0.0, 1.0}), brightness(image, {0.0, 0.0, 1.0}), 2) << x;
  for (double x = -0.65; x < 0.66; x += 0.05)
    EXPECT_NEAR(brightness(image, {x, -0.5, 0.5}), brightness(image, {0.0, -0.5, 0.5}), 2) << x;
  expect_golden("shadows", image);
  scene.shadows = false;
  const Image without = drawn(scene, width, height);
  EXPECT_NEAR(brightness(without, shaded), brightness(without, sunny), 3);
}

}  // namespace
}  // namespace render
