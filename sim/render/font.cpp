#include "sim/render/font.hpp"

#include <freetype/freetype.h>
#include <freetype/ftoutln.h>

#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

#include "sim/render/renderer.hpp"

namespace render {

namespace {

/// The font in all its weights. Only one thread at a time may use FreeType's faces.
class Font {
 public:
  Font() {
    if (FT_Init_FreeType(&library_) != 0) throw std::runtime_error("FreeType does not start");
    for (const char* path : {SEIFBED_FONT_REGULAR, SEIFBED_FONT_BOLD}) {
      FT_Face& face = path == std::string(SEIFBED_FONT_REGULAR) ? regular_.face : bold_.face;
      if (FT_New_Face(library_, path, 0, &face) != 0) {
        FT_Done_FreeType(library_);
        throw std::runtime_error(std::string("the font ") + path +
                                 " is missing: install fonts-roboto-unhinted (Debian)");
      }
    }
  }
  ~Font() { FT_Done_FreeType(library_); }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  static Font& instance() {
    static Font font;
    return font;
  }

  float advance(char32_t character, Weight weight) {
    const std::lock_guard lock(mutex_);
    Face& used = face(weight);
    const auto [found, is_new] = used.advances.try_emplace(character, 0.0F);
    if (is_new) {
      check(FT_Load_Char(used.face, character, FT_LOAD_NO_SCALE));
      found->second = static_cast<float>(used.face->glyph->metrics.horiAdvance) /
                      static_cast<float>(used.face->units_per_EM);
    }
    return found->second;
  }

  Glyph rasterised(char32_t character, Weight weight, float size, float shift) {
    const std::lock_guard lock(mutex_);
    FT_Face face = this->face(weight).face;
    check(FT_Set_Char_Size(face, 0, std::lround(64.0F * size), 72, 72));
    check(FT_Load_Char(face, character, FT_LOAD_TARGET_LIGHT | FT_LOAD_NO_BITMAP));
    FT_Outline_Translate(&face->glyph->outline, std::lround(64.0F * shift), 0);
    check(FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL));
    return copied(*face->glyph);
  }

 private:
  struct Face {
    FT_Face face = nullptr;
    std::map<char32_t, float> advances;  // [em]
  };

  Face& face(Weight weight) { return weight == Weight::regular ? regular_ : bold_; }

  static void check(FT_Error error) {
    if (error != 0) throw std::runtime_error("FreeType failed: error " + std::to_string(error));
  }

  static Glyph copied(const FT_GlyphSlotRec& slot) {
    Glyph glyph;
    glyph.left = slot.bitmap_left;
    glyph.top = slot.bitmap_top;
    glyph.width = static_cast<int>(slot.bitmap.width);
    glyph.height = static_cast<int>(slot.bitmap.rows);
    for (int row = 0; row < glyph.height; ++row) {
      const unsigned char* from = slot.bitmap.buffer + row * slot.bitmap.pitch;
      glyph.cover.insert(glyph.cover.end(), from, from + glyph.width);
    }
    return glyph;
  }

  FT_Library library_ = nullptr;
  Face regular_;
  Face bold_;
  std::mutex mutex_;
};

/// The number of bytes of the character that begins with this byte; 0: no character begins with it.
int length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

}  // namespace

std::vector<char32_t> decoded(const std::string& text) {
  constexpr char32_t replacement = 0xFFFD;
  std::vector<char32_t> characters;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int length = length_of(first);
    char32_t character = length <= 1 ? first : first & (0xFFU >> (length + 1));
    int missing = length - 1;
    for (; missing > 0 && i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
         --missing)
      character = (character << 6U) | (static_cast<unsigned char>(text[i++]) & 0x3FU);
    characters.push_back(length == 0 || missing > 0 ? replacement : character);
  }
  return characters;
}

float advance(char32_t character, Weight weight) { return Font::instance().advance(character, weight); }

Glyph rasterised(char32_t character, Weight weight, float size, float shift) {
  return Font::instance().rasterised(character, weight, size, shift);
}

float text_width(const std::string& text, float size, Weight weight) {
  float width = 0.0F;
  for (const char32_t character : decoded(text)) width += size * advance(character, weight);
  return width;
}

}  // namespace render
