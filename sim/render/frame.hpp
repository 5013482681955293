// A part of the image, and shaders that count in its pixels.
#pragma once

#include "sim/render/program.hpp"

namespace render {

/// [px] from the lower left corner of the image, in the way of OpenGL.
struct Frame {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Drawing is confined to the frame from now on.
void enter(const Gl& gl, const Frame& frame);

enum class Rows { upwards, downwards };  // how y counts

/// GLSL for shaders that count in pixels of a frame: `clip(pixel, depth)` is a vertex there.
extern const char* const frame_glsl;
/// `pixel()` is where a fragment is: the very same numbers whatever is drawn.
extern const char* const pixel_glsl;
/// Names the frame to such shaders.
void set_frame(const Program& program, const Frame& frame, Rows rows);

}  // namespace render
