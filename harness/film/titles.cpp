#include "harness/film/titles.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "harness/film/fitted_text.hpp"
#include "harness/film/paint.hpp"
#include "sim/render/renderer.hpp"

namespace harness {

namespace {

using Overlay = std::vector<render::OverlayItem>;
using Eigen::Vector2f;

void append_text(Overlay& overlay, const Vector2f& position, float size, render::Align align,
                 render::Weight weight, Rgb colour, std::string words) {
  overlay.push_back(render::Text{position, size, align, weight, paint(colour), std::move(words)});
}

void append_box(Overlay& overlay, const Frame& frame, const render::Colour& colour) {
  overlay.push_back(
      render::Rectangle{{frame.x, frame.y}, {frame.x + frame.width, frame.y + frame.height}, colour});
}

std::string figures_of(const BeliefView& belief) {
  if (!belief.failure().empty()) return "failed " + belief.failure();
  std::string text = fmt::format("{} landmarks", belief.landmarks());
  if (belief.links() > 0) text += fmt::format(" · {} links", belief.links());
  if (belief.is_lost()) text += " · lost";
  if (belief.was_found()) text += " · found its place again";
  return text;
}

/// Appends the scale of a matrix: a strip of its shades, and strengths below it.
void append_shades(const Frame& frame, float scale, seif::BeliefMatrix matrix, Overlay& overlay) {
  overlay.push_back(
      MatrixPicture::scale({frame.x, frame.y}, {frame.x + frame.width, frame.y + frame.height}));
  const float baseline = frame.y + frame.height + 10.0F * scale;
  const auto label = [&](float share, render::Align align, std::string words) {
    append_text(overlay, {frame.x + share * frame.width, baseline}, 10.0F * scale, align,
                render::Weight::regular, paints::faint_ink, std::move(words));
  };
  label(0.0F, render::Align::left, "0");
  for (const float strength : MatrixPicture::ticks(matrix)) {
    const float share = MatrixPicture::darkness(matrix, strength);
    label(share, share < 0.99F ? render::Align::centre : render::Align::right, fmt::format("{:g}", strength));
  }
}

}  // namespace

void append_caption(const Frame& frame, float scale, const Caption& caption, Overlay& overlay) {
  append_box(overlay, frame, paint(paints::paper));
  const float baseline = frame.y + 0.5F * frame.height + 6.0F * scale;
  const float gap = 16.0F * scale;
  const float left = frame.x + gap;
  const float facts_size = 15.0F * scale;
  const float name_size = 18.0F * scale;
  const float right = frame.x + frame.width - gap;
  append_text(overlay, {right, baseline}, facts_size, render::Align::right, render::Weight::regular,
              paints::ink, caption.facts);
  const float room =
      right - render::text_width(caption.facts, facts_size, render::Weight::regular) - gap - left;
  const std::string name = fitted(caption.name, name_size, render::Weight::bold, room);
  append_text(overlay, {left, baseline}, name_size, render::Align::left, render::Weight::bold, paints::ink,
              name);
  const float name_width = render::text_width(name, name_size, render::Weight::bold) + gap;
  const float size = 14.0F * scale;
  append_text(overlay, {left + name_width, baseline}, size, render::Align::left, render::Weight::regular,
              paints::faint_ink,
              fitted(caption.description, size, render::Weight::regular, room - name_width));
}

void append_view_title(const Frame& frame, float scale, const BeliefView& belief, Overlay& overlay) {
  const float name_size = 17.0F * scale;
  const float figures_size = 13.0F * scale;
  const float room = frame.width - 72.0F * scale;
  const std::string name = fitted(belief.name(), name_size, render::Weight::bold, room);
  const float name_width = render::text_width(name, name_size, render::Weight::bold);
  const std::string figures =
      fitted(figures_of(belief), figures_size, render::Weight::regular, room - name_width);
  const float width =
      name_width + render::text_width(figures, figures_size, render::Weight::regular) + 48.0F * scale;
  const Frame box{frame.x + 12.0F * scale, frame.y + 12.0F * scale, width, 30.0F * scale};
  append_box(overlay, box, paint(paints::paper, 0.92F));
  append_box(overlay, {box.x, box.y, 6.0F * scale, box.height}, paint(belief.colour()));
  const float baseline = box.y + 20.5F * scale;
  append_text(overlay, {box.x + 16.0F * scale, baseline}, name_size, render::Align::left,
              render::Weight::bold, belief.colour(), name);
  append_text(overlay, {box.x + 30.0F * scale + name_width, baseline}, figures_size, render::Align::left,
              render::Weight::regular, paints::ink, figures);
}

void append_matrix(const Frame& frame, float scale, const BeliefView& belief, Overlay& overlay) {
  const float left = frame.x + 12.0F * scale;
  const bool is_information = belief.kind() == seif::BeliefMatrix::information;
  std::string title = is_information ? "information" : "covariance";
  if (!belief.matrix().empty()) title += fmt::format(", {:.0f} % filled", 100.0 * belief.matrix().fill());
  append_text(overlay, {left, frame.y + 17.0F * scale}, 11.5F * scale, render::Align::left,
              render::Weight::bold, belief.colour(), title);
  const float edge = std::floor(frame.height - 50.0F * scale);
  const Vector2f min(std::round(left), std::round(frame.y + 24.0F * scale));
  const float hair = std::max(1.0F, std::round(scale));
  append_box(overlay, {min.x() - hair, min.y() - hair, edge + 2.0F * hair, edge + 2.0F * hair},
             paint(paints::hairline));
  if (belief.matrix().empty())
    append_box(overlay, {min.x(), min.y(), edge, edge}, paint(paints::paper));
  else
    overlay.push_back(belief.matrix().raster(min, min + Vector2f::Constant(edge)));
  append_shades({min.x(), min.y() + edge + 5.0F * scale, edge, 5.0F * scale}, scale, belief.kind(), overlay);
}

void append_panel(const Layout& layout, Overlay& overlay) {
  if (layout.panel) append_box(overlay, *layout.panel, paint(paints::paper));
  const float hair = std::max(1.0F, layout.scale);
  for (std::size_t i = 1; i < layout.views.size(); ++i) {
    const Frame& view = layout.views[i];
    append_box(overlay, {view.x - hair, view.y, 2.0F * hair, view.height}, paint(paints::paper));
  }
  for (const std::optional<Frame>* part : {&layout.pose_error, &layout.legend}) {
    if (!*part) continue;
    const Frame& frame = **part;
    append_box(overlay, {frame.x, frame.y + 10.0F * layout.scale, hair, frame.height - 20.0F * layout.scale},
               paint(paints::hairline));
  }
}

}  // namespace harness
