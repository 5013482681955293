// Letters as a texture, each drawn once.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "sim/render/font.hpp"
#include "sim/render/gl.hpp"

namespace render {

/// Where a letter is in the texture, and where it goes from the pen.
struct AtlasGlyph {
  int x = 0;  // [px] of its first column and row
  int y = 0;
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

class GlyphAtlas {
 public:
  static constexpr int phases = 4;  // places of the pen within a pixel

  explicit GlyphAtlas(const Gl& gl);

  /// The pen is at `phase`/phases of a pixel. Throws std::runtime_error when letters of too many sizes were
  /// asked for.
  const AtlasGlyph& glyph(char32_t character, Weight weight, float size, int phase);

  /// A texture of one channel; its pixel (0, 0) is full.
  void bind();

 private:
  void grow();

  const Gl& gl_;
  GLuint texture_ = 0;
  std::map<std::tuple<char32_t, Weight, float, int>, AtlasGlyph> glyphs_;
  std::vector<std::uint8_t> pixels_;  // (height x width)
  int height_ = 0;
  int pen_x_ = 2;  // where the next letter goes
  int pen_y_ = 0;
  int row_height_ = 2;
  bool changed_ = true;
};

}  // namespace render
