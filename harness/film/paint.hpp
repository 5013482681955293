// Colours and strokes of films.
#pragma once

#include "harness/figures/palette.hpp"
#include "sim/render/scene.hpp"

namespace harness {

inline render::Colour paint(Rgb rgb, float alpha = 1.0F) {
  const auto channel = [rgb](unsigned shift) { return static_cast<float>((rgb >> shift) & 0xFFU) / 255.0F; };
  return {channel(16U), channel(8U), channel(0U), alpha};
}

namespace paints {
inline constexpr Rgb ink = 0x22272E;        // text
inline constexpr Rgb faint_ink = 0x6B7480;  // less important text, axes
inline constexpr Rgb hairline = 0xD5D9DE;   // frames, grid lines of charts
inline constexpr Rgb paper = 0xFFFFFF;      // behind charts
inline constexpr Rgb post = 0xA9B2BD;       // true positions of landmarks
inline constexpr Rgb wall = 0x9C968E;
inline constexpr Rgb ice = 0xCFE3EE;  // ground with a friction of its own
inline constexpr Rgb box = 0xC0AB8C;
inline constexpr Rgb hidden_ray = 0xE3A98A;
inline constexpr Rgb tyre = 0x2A2D31;
inline constexpr Rgb shell = 0x4A525C;
}  // namespace paints

}  // namespace harness
