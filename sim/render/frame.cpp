#include "sim/render/frame.hpp"

namespace render {

const char* const frame_glsl = R"(
uniform vec4 frame;  // x, y, width, height [px]
uniform float up;    // 1: y counts upwards, -1: downwards
vec4 clip(vec2 pixel, float depth) { return vec4((2.0 * pixel / frame.zw - 1.0) * vec2(1.0, up), depth, 1.0); }
)";

const char* const pixel_glsl = R"(
uniform vec4 frame;
uniform float up;
vec2 pixel() {
  vec2 at = gl_FragCoord.xy - frame.xy;
  return up < 0.0 ? vec2(at.x, frame.w - at.y) : at;
}
)";

void enter(const Gl& gl, const Frame& frame) {
  gl.Viewport(frame.x, frame.y, frame.width, frame.height);
  gl.Scissor(frame.x, frame.y, frame.width, frame.height);
  gl.Enable(GL_SCISSOR_TEST);
}

void set_frame(const Program& program, const Frame& frame, Rows rows) {
  program.set("frame",
              Eigen::Vector4f(Eigen::Vector4i(frame.x, frame.y, frame.width, frame.height).cast<float>()));
  program.set("up", rows == Rows::upwards ? 1.0F : -1.0F);
}

}  // namespace render
