// A part of the image, and shader code that works in its pixels.
#pragma once

#include "sim/render/program.hpp"

namespace render {

/// [px] from the lower left corner of the image, as in OpenGL.
struct Frame {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// From now on, drawing is limited to the frame.
void enter(const Gl& gl, const Frame& frame);

enum class Rows { upwards, downwards };  // the direction of y

/// GLSL for shaders that work in pixels of a frame: `clip(pixel, depth)` gives the position of a vertex.
extern const char* const frame_glsl;
/// `pixel()` is the position of a fragment: exactly the same numbers for everything that is drawn.
extern const char* const pixel_glsl;
/// Passes the frame to a program that uses this GLSL.
void set_frame(const Program& program, const Frame& frame, Rows rows);

}  // namespace render
