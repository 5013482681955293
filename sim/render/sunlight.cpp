#include "sim/render/sunlight.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace render {

const char* const sunlight_glsl = R"(
uniform vec3 sun;    // towards it
uniform vec4 sky;
uniform float haze;  // [1/m]

const vec3 sky_light = vec3(0.56, 0.59, 0.63);
const vec3 ground_light = vec3(0.40, 0.39, 0.38);

// Gamma 2 instead of 2.2: nobody sees it, and it is a square root.
vec3 linear(vec3 srgb) { return srgb * srgb; }
vec3 shown(vec3 light) { return sqrt(clamp(light, 0.0, 1.0)); }

float in_sunlight(vec3 p, vec3 n);

// What faces up in full light keeps its colour.
vec3 lit(vec3 albedo, vec3 p, vec3 n) {
  vec3 sunshine = (1.0 - sky_light) / sun.z;
  return albedo * (mix(ground_light, sky_light, 0.5 + 0.5 * n.z) + sunshine * in_sunlight(p, n));
}

vec3 hazy(vec3 light, vec3 p) {
  return mix(linear(sky.rgb), light, 1.0 / (1.0 + haze * haze * dot(p, p)));
}
)";

const char* const open_glsl = "float in_sunlight(vec3 p, vec3 n) { return max(dot(n, sun), 0.0); }\n";

const char* const shadows_glsl = R"(
uniform mat4 map_from_relative;  // clip coordinates of the shadow map
uniform sampler2DShadow shadow_map;
uniform float shadow_texel;      // [m]; 0: no shadows

const float map_size = 2048.0;   // [px]

float in_sunlight(vec3 p, vec3 n) {
  float facing = dot(n, sun);
  if (facing <= 0.0) return 0.0;
  if (shadow_texel == 0.0) return facing;
  vec3 s = 0.5 + 0.5 * (map_from_relative * vec4(p + 1.5 * shadow_texel * n, 1.0)).xyz;
  vec2 from_centre = 2.0 * s.xy - 1.0;
  float border = smoothstep(0.65, 0.95, dot(from_centre, from_centre));
  if (border >= 1.0) return facing;
  // Four taps of four texels each, turned, so that edges along the map's axes are soft too.
  vec4 taps = vec4(texture(shadow_map, vec3(s.xy + vec2(-0.4, -1.2) / map_size, s.z)),
                   texture(shadow_map, vec3(s.xy + vec2(1.2, -0.4) / map_size, s.z)),
                   texture(shadow_map, vec3(s.xy + vec2(0.4, 1.2) / map_size, s.z)),
                   texture(shadow_map, vec3(s.xy + vec2(-1.2, 0.4) / map_size, s.z)));
  float light = dot(taps, vec4(0.25));
  return facing * mix(light, 1.0, border);
}
)";

namespace {

constexpr GLsizei map_size = 2048;  // [px] a side; as in the shader

/// The rows are two axes across the sunlight, and the direction towards the sun.
Eigen::Matrix3d sun_rotation() {
  const Eigen::Vector3d sun = Eigen::Vector3d(-0.50, -0.42, 0.95).normalized();
  Eigen::Matrix3d R;
  R.row(0) = Eigen::Vector3d::UnitZ().cross(sun).normalized();
  R.row(1) = sun.cross(Eigen::Vector3d(R.row(0)));
  R.row(2) = sun;
  return R;
}

const Eigen::Matrix3d R_sun_world = sun_rotation();

/// Zooming would move the texels of the shadows. With a radius in steps, that happens rarely.
double stepped(double radius) {
  const double step = std::log(1.25);
  return std::exp(step * std::ceil(std::log(radius) / step));
}

}  // namespace

Sunlight::Sunlight(const Gl& gl) : gl_(gl) {
  gl_.GenTextures(1, &map_);
  gl_.BindTexture(GL_TEXTURE_2D, map_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, map_size, map_size, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                 nullptr);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  gl_.GenFramebuffers(1, &target_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map_, 0);
  gl_.DrawBuffer(GL_NONE);
  gl_.ReadBuffer(GL_NONE);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the graphics library cannot draw shadow maps");
}

void Sunlight::fit(const Projection& projection, bool shadows, const Colour& sky) {
  shadows_ = shadows;
  sky_ = sky;
  haze_ = projection.perspective() ? static_cast<float>(1.0 / (14.0 * projection.distance())) : 0.0F;
  radius_ = stepped(projection.field_radius());
  // Moves by whole texels, so that shadows do not change while the camera moves.
  const double texel = 2.0 * radius_ / map_size;
  p_sun_field_ = R_sun_world * projection.field_centre();
  for (int axis = 0; axis < 3; ++axis) p_sun_field_(axis) = texel * std::round(p_sun_field_(axis) / texel);
  const Eigen::Vector3d p_sun_origin = R_sun_world * projection.origin();
  const Eigen::Vector3d scale = Eigen::Vector3d(1.0, 1.0, -1.0) / radius_;
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  map.topLeftCorner<3, 3>() = scale.asDiagonal() * R_sun_world;
  map.topRightCorner<3, 1>() = scale.cwiseProduct(p_sun_origin - p_sun_field_);
  map_from_relative_ = map.cast<float>();
}

void Sunlight::begin_shadows() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_);
  gl_.Viewport(0, 0, map_size, map_size);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_DEPTH_CLAMP);  // things nearer to the sun than the map throw shadows, too
  gl_.Enable(GL_CULL_FACE);
  gl_.CullFace(GL_FRONT);  // so that no lit face shadows itself
}

void Sunlight::end_shadows() const {
  gl_.Disable(GL_DEPTH_CLAMP);
  gl_.Disable(GL_CULL_FACE);
  gl_.CullFace(GL_BACK);
}

bool Sunlight::throws_shadow(const Eigen::Vector3d& p_world, double radius) const {
  return shadows_ && (R_sun_world * p_world - p_sun_field_).head<2>().norm() < radius_ + radius;
}

Shade Sunlight::shade_of(const Eigen::Matrix3f& axes, const Eigen::Vector3f& centre, float height) const {
  const bool is_upright = axes.col(2).head<2>().isZero(1e-6F) && axes.row(2).head<2>().isZero(1e-6F);
  // The frame that fits the thing better: its own, or the world's.
  Eigen::Matrix2f frame = Eigen::Matrix2f::Identity();
  Eigen::Vector2f half = 0.5F * axes.cwiseAbs().rowwise().sum().head<2>();
  if (is_upright) {
    half = 0.5F * axes.topLeftCorner<2, 2>().colwise().norm().transpose();
    frame = axes.topLeftCorner<2, 2>().colwise().normalized();
  }
  const Eigen::Vector3f sun = R_sun_world.row(2).transpose().cast<float>();
  const float top = centre.z() + height + 0.5F * axes.row(2).cwiseAbs().sum();  // [m] above the ground
  const Eigen::Vector2f swept = frame.transpose() * (-std::max(top, 0.0F) / sun.z() * sun.head<2>());
  constexpr float blur = 6.0F;  // [-] texels that taps and normal offset reach to each side, at a slant
  const auto margin = Eigen::Vector2f::Constant(blur * static_cast<float>(2.0 * radius_ / map_size));
  const Eigen::Vector2f least = -half + swept.cwiseMin(0.0F) - margin;
  const Eigen::Vector2f most = half + swept.cwiseMax(0.0F) + margin;
  return {centre.head<2>() + frame * least, (most - least).x() * frame.col(0),
          (most - least).y() * frame.col(1)};
}

void Sunlight::set(const Program& program) const {
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, map_);
  program.set("shadow_map", 0);
  program.set("map_from_relative", map_from_relative_);
  program.set("shadow_texel", shadows_ ? static_cast<float>(2.0 * radius_ / map_size) : 0.0F);
  set_open(program);
}

void Sunlight::set_open(const Program& program) const {
  program.set("sun", Eigen::Vector3f(R_sun_world.row(2).transpose().cast<float>()));
  set_haze(program);
}

void Sunlight::set_haze(const Program& program) const {
  program.set("sky", sky_);
  program.set("haze", haze_);
}

}  // namespace render
