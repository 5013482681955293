#include "harness/film/fitted_text.hpp"

#include "sim/render/renderer.hpp"

namespace harness {

namespace {

/// UTF-8: such a byte continues a character.
bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

void remove_last_character(std::string& text) {
  while (!text.empty() && is_continuation(text.back())) text.pop_back();
  if (!text.empty()) text.pop_back();
}

}  // namespace

std::string fitted(std::string text, float size, render::Weight weight, float room) {
  if (render::text_width(text, size, weight) <= room) return text;
  while (!text.empty() && render::text_width(text + "\u2026", size, weight) > room)
    remove_last_character(text);
  return text.empty() ? text : text + "\u2026";
}

}  // namespace harness
