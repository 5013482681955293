// Charts of a quantity over the time of a run.
#pragma once

#include <string>
#include <vector>

#include "harness/figures/palette.hpp"
#include "harness/film/series.hpp"
#include "sim/render/scene.hpp"

namespace harness {

struct Curve {
  std::string label;
  Rgb colour = 0;
  const Series* values = nullptr;
  const Series* band = nullptr;  // from zero up to this curve; null: no band
};

enum class Scale { linear, logarithmic };

/// A rectangle of the image. [px]
struct Frame {
  float x = 0.0F;  // of its left edge
  float y = 0.0F;  // of its upper edge
  float width = 0.0F;
  float height = 0.0F;
};

struct Chart {
  Frame frame;
  std::string title;
  std::string unit;
  int decimals = 0;  // digits after the decimal point of the latest values
  Scale scale = Scale::linear;
  std::vector<Curve> curves;
};

/// A dashed line; all lengths in pixels.
struct Dashes {
  float width = 0.0F;
  float length = 0.0F;  // of a dash
  float gap = 0.0F;
  render::Colour colour;
};

/// The dashes of a band's edge.
Dashes chart_dashes(float scale, Rgb colour);

inline constexpr float band_alpha = 0.14F;  // [-] of a filled band

void append_dashes(const std::vector<Eigen::Vector2f>& points, const Dashes& dashes,
                   std::vector<render::OverlayItem>& overlay);

/// Appends the chart and its axes. The band of the first curve is filled, that of each other has a dashed edge:
/// so bands that lie on each other can be told apart. The vertical axis ends at a round number at or above the
/// largest value. All lengths but those of the frame are multiplied by `scale`.
void append_chart(const Chart& chart, float scale, std::vector<render::OverlayItem>& overlay);

}  // namespace harness
