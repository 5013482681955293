// Properties of every scene.
#include "sim/render/renderer.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>

#include "pictures.hpp"
#include "scenes.hpp"
#include "sim/render/context.hpp"

namespace render {
namespace {

using namespace test;

Scene small_yard() {
  Scene scene = yard(60, 40);
  scene.overlay.clear();
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    View& view = scene.views[i];
    view.x = 160 * static_cast<int>(i);
    view.y = 0;
    view.width = 160;
    view.height = 180;
  }
  return scene;
}

TEST(Renderer, DrawsTheSamePixelsAgain) {
  const Scene scene = yard(100, 60);
  Renderer renderer(1280, 720);
  Image first;
  renderer.draw(scene, first);
  Image other;
  renderer.draw(bare(640, 360, from_above({3.0, 2.0, 0.0}, 7.0)), other);
  Image second;
  renderer.draw(scene, second);
  EXPECT_EQ(first.rgb, second.rgb);
  EXPECT_NE(first.rgb, other.rgb);
  EXPECT_EQ(first.rgb, drawn(scene, 1280, 720).rgb);  // by another one, too
}

template <typename Points>
void move(Points& points, const Eigen::Vector3d& by) {
  for (auto& point : points) point.centre += by;
}

void move(Things& things, const Eigen::Vector3d& by) {
  for (Solid& solid : things.solids) solid.T_world_solid.pretranslate(by);
  for (Post& post : things.posts) post.position += by.head<2>();
  for (Marks* marks : {&things.marks, &things.marks_on_top}) {
    move(marks->ellipses, by);
    move(marks->dots, by);
    for (Stroke& stroke : marks->strokes) {
      stroke.from += by;
      stroke.to += by;
    }
  }
}

TEST(Renderer, DrawsFarFromTheOriginAsAtIt) {
  Scene near = small_yard();
  near.ground.size = {4e4, 4e4};
  Scene far = near;
  const Eigen::Vector3d by(10'000.0, -10'000.0, 0.0);  // a multiple of the grid
  move(far.things, by);
  for (View& view : far.views) {
    view.camera.eye += by;
    view.camera.target += by;
  }
  // The texels of the shadow map are fixed to the world, so they lie differently below the same shadows.
  const Difference off = difference(drawn(near, 320, 180), drawn(far, 320, 180));
  EXPECT_LT(off.mean, 0.3);
  EXPECT_LT(off.share, 0.003);
  near.shadows = far.shadows = false;
  const Difference bare_off = difference(drawn(near, 320, 180), drawn(far, 320, 180));
  EXPECT_LT(bare_off.mean, 0.02);
  EXPECT_EQ(bare_off.share, 0.0);
}

TEST(Renderer, RefusesSizesThatCannotBe) {
  EXPECT_THROW(Renderer(0, 100), std::invalid_argument);
  EXPECT_THROW(Renderer(100, -1), std::invalid_argument);
  EXPECT_THROW(Renderer(1'000'000, 100), std::invalid_argument);
}

TEST(Renderer, SaysWhatDraws) { EXPECT_NE(Renderer(16, 16).description().find("Mesa"), std::string::npos); }

TEST(Renderer, SaysWhatToInstall) {
  try {
    const Context context({"libNoSuchMesa.so.8", "libNoSuchMesa.so"});
    FAIL() << "there is such a library";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("is missing: install libosmesa6"), std::string::npos)
        << error.what();
  }
}

/// [MiB]
double resident_memory() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0;
  double resident = 0.0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

TEST(Renderer, NeedsNoMoreMemoryFrameAfterFrame) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps what was freed";
#endif
  Scene scene = small_yard();
  scene.overlay = {Text{{20.0F, 20.0F}, 14.0F, Align::left, Weight::regular, black, "0123456789"}};
  Renderer renderer(320, 180);
  Image image;
  const auto draw_frames = [&](int count) {
    for (int i = 0; i < count; ++i) {
      scene.views[0].camera.eye.x() += 0.01;
      std::get<Text>(scene.overlay[0]).position.x() += 0.3F;
      renderer.draw(scene, image);
    }
  };
  draw_frames(50);
  const double before = resident_memory();
  draw_frames(200);
  // The buffers of one frame are 0.2 MiB: if they were kept, it would be 40 MiB.
  EXPECT_LT(resident_memory() - before, 4.0);
}

TEST(Renderer, DrawsPostsOfEverySize) {
  // The same field from larger and larger distances: the share of the image that posts cover stays the same.
  for (const double scale : {1.0, 0.1, 0.02}) {
    Scene scene = blank(from_above({0.0, 0.0, 0.0}, 10.0));
    for (int i = -30; i < 30; ++i) {
      for (int j = -15; j < 15; ++j) {
        Post post;
        post.position = {0.25 * i, 0.25 * j};
        post.radius = static_cast<float>(0.1 * scale);
        post.height = 0.01F;
        scene.things.posts.push_back(post);
      }
    }
    const Image image = drawn(scene, 320, 180);
    const double expected = 1800 * std::numbers::pi * 0.01 * scale * scale * 18.0 * 18.0;
    // A speck is never smaller than a pixel, so that it does not flicker. If a sample lies on its border, two
    // pixels may show it.
    EXPECT_GE(ink(image), 0.97 * expected) << scale;
    EXPECT_LE(ink(image), std::max(1.03 * expected, 1.01 * 1800.0)) << scale;
  }
}

}  // namespace
}  // namespace render
