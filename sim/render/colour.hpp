// Colours.
#pragma once

namespace render {

/// A colour in sRGB, each component in [0, 1]; alpha is not premultiplied.
struct Colour {
  float r = 0.0F;
  float g = 0.0F;
  float b = 0.0F;
  float a = 1.0F;
};

}  // namespace render
