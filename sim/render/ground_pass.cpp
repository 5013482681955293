#include "sim/render/ground_pass.hpp"

#include <cmath>
#include <string>

namespace render {

namespace {

// A part of the ground.
const char* const ground_vertex_shader = R"(
layout(location = 0) in vec2 corner_of_part;
layout(location = 1) in vec2 along;
layout(location = 2) in vec2 across;
uniform mat4 clip_from_relative;
uniform float origin_height;  // [m]
void main() {
  vec2 p = corner_of_part + float(gl_VertexID & 1) * along + float(gl_VertexID >> 1) * across;
  gl_Position = clip_from_relative * vec4(p, -origin_height, 1.0);
}
)";

const char* const ground_fragment_shader = R"(
uniform vec2 corner;         // [px] of the view
uniform bool perspective;
uniform mat3 ray_start;
uniform mat3 ray_direction;
uniform float origin_height;
uniform vec2 phase;           // of the origin in the stronger grid [-]
uniform vec4 edges;           // least x, y and greatest x, y, relative to the origin [m]
uniform float grid;           // [m]; 0: none
uniform vec4 colour;
uniform vec4 lines;
out vec4 painted;

// How much of the pixel is line; `width` in pixels. Lines that come too close to each other fade out.
float on_lines(vec2 cell, vec2 pixel_in_cells, float width) {
  vec2 away = abs(cell - round(cell)) / pixel_in_cells;
  vec2 cover = clamp(0.5 * width + 0.5 - away, 0.0, 1.0) * (1.0 - smoothstep(0.08, 0.25, pixel_in_cells));
  return max(cover.x, cover.y);
}

// Along x and y. [m]
vec2 length_of_pixel(vec3 p) { return sqrt(dFdx(p.xy) * dFdx(p.xy) + dFdy(p.xy) * dFdy(p.xy)); }

void main() {
  vec3 pixel = vec3(gl_FragCoord.xy - corner, 1.0);
  vec3 start = ray_start * pixel;
  vec3 direction = ray_direction * pixel;
  float t = -(origin_height + start.z) / (abs(direction.z) > 1e-7 ? direction.z : 1e-7);
  // At the horizon the corner of a pixel may see ground that its centre does not.
  if (perspective && t < 0.0) t = 1e7 * abs(origin_height);
  vec3 p = start + t * direction;
  vec3 albedo = linear(colour.rgb);
  if (grid > 0.0) {
    vec2 fifth = p.xy / (5.0 * grid) + phase;
    vec2 pixel_in_fifths = max(length_of_pixel(p) / (5.0 * grid), 1e-7);
    float thin = 0.55 * on_lines(5.0 * fifth, 5.0 * pixel_in_fifths, 1.0);
    float strong = on_lines(fifth, pixel_in_fifths, 1.3);
    albedo = mix(albedo, linear(lines.rgb), max(thin, strong));
  }
  vec2 inside = min(p.xy - edges.xy, edges.zw - p.xy);
  vec2 cover = clamp(0.5 + inside / max(length_of_pixel(p), vec2(1e-9)), 0.0, 1.0);
  painted = min(cover.x, cover.y) * vec4(shown(hazy(lit(albedo, p, vec3(0.0, 0.0, 1.0)), p)), 1.0);
}
)";

/// The position of the origin within a period of `period` [m], in [0, 1).
float phase_of(double origin, double period) {
  return static_cast<float>(origin / period - std::floor(origin / period));
}

}  // namespace

GroundPass::GroundPass(const Gl& gl)
    : gl_(gl),
      open_(gl, "ground", ground_vertex_shader,
            std::string(sunlight_glsl) + open_glsl + ground_fragment_shader),
      shaded_(gl, "shaded ground", ground_vertex_shader,
              std::string(sunlight_glsl) + shadows_glsl + ground_fragment_shader),
      parts_(gl, {{2}, {2}, {2}}),
      whole_(1) {}

void GroundPass::set(const Program& program, const Ground& ground, const Projection& projection,
                     const Frame& frame) const {
  const Eigen::Vector3d& origin = projection.origin();
  program.set("clip_from_relative", projection.clip_from_relative());
  program.set("corner", Eigen::Vector2f(static_cast<float>(frame.x), static_cast<float>(frame.y)));
  program.set("perspective", projection.perspective() ? 1 : 0);
  program.set("ray_start", projection.ray_start());
  program.set("ray_direction", projection.ray_direction());
  program.set("origin_height", static_cast<float>(origin.z()));
  const Eigen::Vector2d least = -0.5 * ground.size - origin.head<2>();
  const Eigen::Vector2f from = least.cast<float>();
  const Eigen::Vector2f to = (least + ground.size).cast<float>();
  program.set("edges", Eigen::Vector4f(from.x(), from.y(), to.x(), to.y()));
  const double period = ground.grid > 0.0 ? 5.0 * ground.grid : 1.0;
  program.set("phase", Eigen::Vector2f(phase_of(origin.x(), period), phase_of(origin.y(), period)));
  program.set("grid", static_cast<float>(ground.grid));
  program.set("colour", ground.colour);
  program.set("lines", ground.lines);
}

void GroundPass::draw(const Ground& ground, const Projection& projection, const Frame& frame,
                      const Sunlight& sunlight, const std::vector<Shade>& shades) {
  gl_.Disable(GL_CULL_FACE);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Enable(GL_BLEND);
  // A little larger than the ground: the fragments draw its edge.
  const Eigen::Vector2d size = 1.05 * ground.size;
  const Eigen::Vector2d corner = -0.5 * size - projection.origin().head<2>();
  whole_[0] = {
      corner.cast<float>(), {static_cast<float>(size.x()), 0.0F}, {0.0F, static_cast<float>(size.y())}};
  open_.use();
  sunlight.set_open(open_);
  set(open_, ground, projection, frame);
  parts_.draw(whole_);
  if (shades.empty()) return;
  shaded_.use();
  sunlight.set(shaded_);
  set(shaded_, ground, projection, frame);
  parts_.draw(shades);
}

}  // namespace render
