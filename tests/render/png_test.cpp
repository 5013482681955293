// Images are unchanged after they are written to a file and read back.
#include "sim/render/png.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace render {
namespace {

Image pattern() {
  Image image = {37, 21, {}};
  for (int i = 0; i < 37 * 21 * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>((i * i) % 251));
  return image;
}

std::string bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Png, ComesBackAsItWas) {
  const std::string path = testing::TempDir() + "render_png_test.png";
  write_png(path, pattern());
  const Image image = read_png(path);
  EXPECT_EQ(image.width, 37);
  EXPECT_EQ(image.height, 21);
  EXPECT_EQ(image.rgb, pattern().rgb);
}

TEST(Png, OfTheSameImageHasTheSameBytes) {
  const std::string path = testing::TempDir() + "render_png_twice_test.png";
  write_png(path, pattern());
  const std::string first = bytes(path);
  write_png(path, pattern());
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(bytes(path), first);
}

TEST(Png, FailureNamesTheFile) {
  const std::string nowhere = testing::TempDir() + "no_such_folder/a.png";
  const auto names_file = [&](auto&& call) {
    try {
      call();
    } catch (const std::runtime_error& error) {
      return std::string(error.what()).find(nowhere) != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(names_file([&] { write_png(nowhere, pattern()); }));
  EXPECT_TRUE(names_file([&] { read_png(nowhere); }));
}

}  // namespace
}  // namespace render
