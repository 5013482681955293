#include "sim/render/png.hpp"

#include <png.h>

#include <stdexcept>
#include <string>

namespace render {

namespace {

png_image described(const Image& image) {
  png_image png = {};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png.flags = PNG_IMAGE_FLAG_FAST;
  return png;
}

[[noreturn]] void fail(const char* what, const std::filesystem::path& path, png_image& png) {
  const std::string message = png.message;
  png_image_free(&png);
  throw std::runtime_error(std::string(what) + path.string() + ": " + message);
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image) {
  png_image png = described(image);
  if (png_image_write_to_file(&png, path.c_str(), 0, image.rgb.data(), 0, nullptr) == 0)
    fail("cannot write the image ", path, png);
}

Image read_png(const std::filesystem::path& path) {
  Image image;
  png_image png = described(image);
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) fail("cannot read the image ", path, png);
  png.format = PNG_FORMAT_RGB;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.rgb.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr) == 0)
    fail("cannot read the image ", path, png);
  return image;
}

}  // namespace render
