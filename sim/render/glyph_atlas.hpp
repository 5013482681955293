// A texture of glyphs. Each glyph is drawn into it once.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "sim/render/font.hpp"
#include "sim/render/gl.hpp"

namespace render {

/// The position of a glyph in the texture, and relative to the pen.
struct AtlasGlyph {
  int x = 0;  // [px] the first column and row
  int y = 0;
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

class GlyphAtlas {
 public:
  static constexpr int phases = 4;  // positions of the pen within a pixel

  explicit GlyphAtlas(const Gl& gl);

  /// The pen is at `phase`/phases of a pixel. Throws std::runtime_error if too many sizes of letters were asked
  /// for.
  const AtlasGlyph& glyph(char32_t character, Weight weight, float size, int phase);

  /// Binds the texture. It has one channel; its pixel (0, 0) is fully covered.
  void bind();

 private:
  void grow();

  const Gl& gl_;
  GLuint texture_ = 0;
  std::map<std::tuple<char32_t, Weight, float, int>, AtlasGlyph> glyphs_;
  std::vector<std::uint8_t> pixels_;  // (height x width)
  int height_ = 0;
  int pen_x_ = 2;  // the place of the next glyph
  int pen_y_ = 0;
  int row_height_ = 2;
  bool changed_ = true;
};

}  // namespace render
