// Characters and their pictures (glyphs).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/render/scene.hpp"

namespace render {

/// Decodes UTF-8; invalid bytes become U+FFFD.
std::vector<char32_t> decoded(const std::string& text);

/// A picture of a character. [px]
struct Glyph {
  int left = 0;  // from the pen to the first column
  int top = 0;   // from the baseline up to the first row
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cover;  // (height x width), rows from the top
};

/// How far the pen moves for a character. [em] Throws std::runtime_error if the font is missing.
float advance(char32_t character, Weight weight);

/// The glyph of a character at this size [px of the em], `shift` of a pixel to the right of the pen. Throws as
/// `advance` does.
Glyph rasterised(char32_t character, Weight weight, float size, float shift);

}  // namespace render
