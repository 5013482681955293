// Letters.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/render/scene.hpp"

namespace render {

/// The characters of UTF-8; what is none becomes U+FFFD.
std::vector<char32_t> decoded(const std::string& text);

/// A picture of a character. [px]
struct Glyph {
  int left = 0;  // from the pen to its first column
  int top = 0;   // from the baseline up to its first row
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cover;  // (height x width), from the top
};

/// How far the pen moves on after a character. [em] Throws std::runtime_error if the font is missing.
float advance(char32_t character, Weight weight);

/// The character at this size [px of the em], `shift` of a pixel right of the pen. Throws as `advance` does.
Glyph rasterised(char32_t character, Weight weight, float size, float shift);

}  // namespace render
