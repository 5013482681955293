#include "sim/render/things_pass.hpp"

#include <algorithm>
#include <string>

namespace render {

namespace {

// [px] A post smaller than the first is drawn as a speck, one thinner than the second as a prism with few
// sides.
constexpr double speck_below = 2.0;
constexpr double coarse_below = 8.0;

const char* const instance_glsl = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 axis_x;
layout(location = 3) in vec3 axis_y;
layout(location = 4) in vec3 axis_z;
layout(location = 5) in vec3 centre;
layout(location = 6) in vec4 rgba;
uniform mat4 clip_from_relative;
vec3 placed() { return centre + mat3(axis_x, axis_y, axis_z) * position; }
)";

const char* const shape_vertex_shader = R"(
uniform float origin_height;  // [m]
out vec3 p;
out vec3 n;
flat out vec3 albedo;
void main() {
  p = placed();
  n = axis_x * (normal.x / dot(axis_x, axis_x)) + axis_y * (normal.y / dot(axis_y, axis_y)) +
      axis_z * (normal.z / dot(axis_z, axis_z));
  albedo = rgba.rgb;
  gl_Position = clip_from_relative * vec4(p, 1.0);
  gl_ClipDistance[0] = origin_height >= 0.0 ? p.z + origin_height + 1e-4 : 1.0;  // below ground
}
)";

const char* const shape_fragment_shader = R"(
in vec3 p;
in vec3 n;
flat in vec3 albedo;
out vec4 painted;
void main() {
  painted = vec4(shown(hazy(lit(linear(albedo), p, normalize(n)), p)), 1.0);
}
)";

const char* const shadow_vertex_shader = R"(
void main() { gl_Position = clip_from_relative * vec4(placed(), 1.0); }
)";

const char* const shadow_fragment_shader = "void main() {}\n";

const char* const speck_vertex_shader = R"(
layout(location = 0) in vec3 centre;
layout(location = 1) in float size;
layout(location = 2) in vec4 rgba;
uniform mat4 clip_from_relative;
flat out vec3 light;
void main() {
  gl_Position = clip_from_relative * vec4(centre, 1.0);
  gl_PointSize = size;
  // Half of it faces the sky, half the sun: what a post looks like on the whole.
  light = shown(hazy(0.85 * linear(rgba.rgb), centre));
}
)";

const char* const speck_fragment_shader = R"(
flat in vec3 light;
out vec4 painted;
void main() { painted = vec4(light, 1.0); }
)";

VertexArray instanced(const Gl& gl, const Mesh& mesh) {
  return VertexArray(gl, mesh, {{3}, {3}, {3}, {3}, {Attribute::colour}});
}

}  // namespace

ThingsPass::ThingsPass(const Gl& gl)
    : gl_(gl),
      shape_(gl, "things", std::string(instance_glsl) + shape_vertex_shader,
             std::string(sunlight_glsl) + shadows_glsl + shape_fragment_shader),
      shadow_(gl, "shadows", std::string(instance_glsl) + shadow_vertex_shader, shadow_fragment_shader),
      speck_(gl, "specks", std::string(sunlight_glsl) + open_glsl + speck_vertex_shader,
             speck_fragment_shader),
      drawn_{Drawn(instanced(gl, box_mesh())), Drawn(instanced(gl, cylinder_mesh(32, Bottom::closed))),
             Drawn(instanced(gl, cylinder_mesh(24, Bottom::open))),
             Drawn(instanced(gl, cylinder_mesh(8, Bottom::open)))},
      speck_vertices_(gl, {{3}, {1}, {Attribute::colour}}) {}

void ThingsPass::begin(const Projection& projection, const Sunlight& sunlight) {
  projection_ = &projection;
  sunlight_ = &sunlight;
  specks_.clear();
  shades_.clear();
  for (Drawn& drawn : drawn_) {
    drawn.seen.clear();
    drawn.throwing.clear();
  }
}

void ThingsPass::add(const Things& things) {
  for (const Solid& solid : things.solids) add(solid);
  for (const Post& post : things.posts) add(post);
}

void ThingsPass::add(const Solid& solid) {
  Drawn& drawn = drawn_[solid.shape == Shape::box ? box : cylinder];
  const Eigen::Vector3d centre = solid.T_world_solid.translation();
  const double radius = 0.5 * solid.size.norm();
  Instance instance;
  instance.axes = (solid.T_world_solid.linear() * solid.size.asDiagonal()).cast<float>();
  instance.centre = (centre - projection_->origin()).cast<float>();
  instance.colour = Rgba(solid.colour);
  if (projection_->sees(centre, radius)) drawn.seen.push_back(instance);
  if (sunlight_->throws_shadow(centre, radius)) throw_shadow(drawn, instance);
}

void ThingsPass::add(const Post& post) {
  const Eigen::Vector3d centre(post.position.x(), post.position.y(), 0.5 * static_cast<double>(post.height));
  const Eigen::Vector3f size(2.0F * post.radius, 2.0F * post.radius, post.height);
  const double radius = 0.5 * static_cast<double>(size.norm());
  const bool seen = projection_->sees(centre, radius);
  const bool throwing = sunlight_->throws_shadow(centre, radius);
  if (!seen && !throwing) return;
  const double scale = projection_->pixels_per_metre(centre);
  Instance instance;
  instance.axes = size.asDiagonal();
  instance.centre = (centre - projection_->origin()).cast<float>();
  instance.colour = Rgba(post.colour);
  if (scale * static_cast<double>(size.maxCoeff()) < speck_below) {
    const auto speck_size = static_cast<float>(std::max(1.0, scale * static_cast<double>(size.maxCoeff())));
    if (seen) specks_.push_back({instance.centre, speck_size, instance.colour});
    return;
  }
  Drawn& drawn = drawn_[scale * static_cast<double>(size.x()) < coarse_below ? coarse_post : fine_post];
  if (seen) drawn.seen.push_back(instance);
  if (throwing) throw_shadow(drawn, instance);
}

void ThingsPass::throw_shadow(Drawn& drawn, const Instance& instance) {
  drawn.throwing.push_back(instance);
  shades_.push_back(
      sunlight_->shade_of(instance.axes, instance.centre, static_cast<float>(projection_->origin().z())));
}

void ThingsPass::draw_shadows() {
  sunlight_->begin_shadows();
  shadow_.use();
  shadow_.set("clip_from_relative", sunlight_->map_from_relative());
  for (Drawn& drawn : drawn_) drawn.vertices.draw(drawn.throwing);
  sunlight_->end_shadows();
}

void ThingsPass::draw() {
  gl_.Enable(GL_CULL_FACE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_CLIP_DISTANCE0);
  shape_.use();
  sunlight_->set(shape_);
  shape_.set("clip_from_relative", projection_->clip_from_relative());
  shape_.set("origin_height", static_cast<float>(projection_->origin().z()));
  for (Drawn& drawn : drawn_) drawn.vertices.draw(drawn.seen);
  gl_.Disable(GL_CLIP_DISTANCE0);
  gl_.Disable(GL_CULL_FACE);
  if (specks_.empty()) return;
  speck_.use();
  sunlight_->set_haze(speck_);
  speck_.set("clip_from_relative", projection_->clip_from_relative());
  speck_vertices_.draw_points(specks_);
}

}  // namespace render
