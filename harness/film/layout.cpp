#include "harness/film/layout.hpp"

#include <algorithm>
#include <cmath>

namespace harness {

namespace {

constexpr float caption_height = 44.0F;  // [px] of 720
constexpr float panel_height = 156.0F;   // [px] of 720
constexpr float matrix_width = 146.0F;   // [px] of 1280
constexpr float legend_width = 330.0F;   // [px] of 1280

/// Cuts a part of this width from the left (or the right) of the panel's free part.
Frame take_left(Frame& rest, float width) {
  const Frame part{rest.x, rest.y, width, rest.height};
  rest.x += width;
  rest.width -= width;
  return part;
}

Frame take_right(Frame& rest, float width) {
  rest.width -= width;
  return {rest.x + rest.width, rest.y, width, rest.height};
}

/// The charts share the room that matrices and legend leave.
void divide_panel(Layout& layout, const worlds::FilmLayers& layers, const std::vector<bool>& keeps_matrix) {
  Frame rest = *layout.panel;
  for (const bool keeps : keeps_matrix) {
    layout.matrices.emplace_back();
    if (layers.matrix && keeps) layout.matrices.back() = take_left(rest, matrix_width * layout.scale);
  }
  if (layers.legend) layout.legend = take_right(rest, legend_width * layout.scale);
  const float width = layers.times && layers.pose_error ? 0.5F * rest.width : rest.width;
  if (layers.times) layout.times = take_left(rest, width);
  if (layers.pose_error) layout.pose_error = take_left(rest, width);
}

}  // namespace

Layout layout_of(const worlds::Film& film, const std::vector<bool>& keeps_matrix) {
  const auto width = static_cast<float>(film.width);
  const auto height = static_cast<float>(film.height);
  Layout layout;
  layout.scale = std::min(height / 720.0F, width / 1280.0F);
  float top = 0.0F;
  float bottom = height;
  if (film.layers.caption) {
    top = std::round(caption_height * layout.scale);
    layout.caption = Frame{0.0F, 0.0F, width, top};
  }
  if (film.layers.times || film.layers.pose_error || film.layers.legend ||
      (film.layers.matrix && std::ranges::find(keeps_matrix, true) != keeps_matrix.end())) {
    bottom -= std::round(panel_height * layout.scale);
    layout.panel = Frame{0.0F, bottom, width, height - bottom};
    divide_panel(layout, film.layers, keeps_matrix);
  }
  const int views = std::max(1, static_cast<int>(keeps_matrix.size()));
  for (int i = 0; i < views; ++i) {
    const float left = std::round(width * static_cast<float>(i) / static_cast<float>(views));
    const float right = std::round(width * static_cast<float>(i + 1) / static_cast<float>(views));
    layout.views.push_back({left, top, right - left, bottom - top});
  }
  return layout;
}

}  // namespace harness
