#include "sim/render/glyph_atlas.hpp"

#include <algorithm>
#include <stdexcept>

namespace render {

namespace {

constexpr int atlas_width = 1024;  // [px]
constexpr int most_height = 8192;  // [px]

}  // namespace

GlyphAtlas::GlyphAtlas(const Gl& gl) : gl_(gl) {
  gl_.GenTextures(1, &texture_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  grow();
  pixels_[0] = 255;
}

void GlyphAtlas::grow() {
  if (height_ >= most_height) throw std::runtime_error("text of too many sizes");
  height_ = std::max(256, 2 * height_);
  pixels_.resize(static_cast<std::size_t>(atlas_width) * static_cast<std::size_t>(height_));
}

const AtlasGlyph& GlyphAtlas::glyph(char32_t character, Weight weight, float size, int phase) {
  const auto [found, is_new] = glyphs_.try_emplace({character, weight, size, phase});
  AtlasGlyph& placed = found->second;
  if (!is_new) return placed;
  const Glyph glyph = rasterised(character, weight, size, static_cast<float>(phase) / phases);
  if (glyph.width > atlas_width) throw std::runtime_error("a letter is too large");
  if (pen_x_ + glyph.width > atlas_width) {
    pen_x_ = 0;
    pen_y_ += row_height_;
    row_height_ = 0;
  }
  while (pen_y_ + glyph.height > height_) grow();
  placed = {pen_x_, pen_y_, glyph.left, glyph.top, glyph.width, glyph.height};
  for (int row = 0; row < glyph.height; ++row) {
    std::copy_n(glyph.cover.begin() + row * glyph.width, glyph.width,
                pixels_.begin() + static_cast<std::ptrdiff_t>(pen_y_ + row) * atlas_width + pen_x_);
  }
  pen_x_ += glyph.width;
  row_height_ = std::max(row_height_, glyph.height);
  changed_ = true;
  return placed;
}

void GlyphAtlas::bind() {
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  if (!changed_) return;
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas_width, height_, 0, GL_RED, GL_UNSIGNED_BYTE, pixels_.data());
  changed_ = false;
}

}  // namespace render
