// Images in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace render {

/// An image. Rows from top to bottom, pixels from left to right, with red, green and blue in sRGB.
struct Image {
  int width = 0;                  // [px]
  int height = 0;                 // [px]
  std::vector<std::uint8_t> rgb;  // (height x width x 3)

  const std::uint8_t* pixel(int x, int y) const {
    return &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x))];
  }
};

}  // namespace render
