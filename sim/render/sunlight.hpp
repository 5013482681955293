// One sun, the sky, and the shadows.
#pragma once

#include <Eigen/Core>

#include "sim/render/program.hpp"
#include "sim/render/projection.hpp"

namespace render {

/// GLSL, to be followed by open_glsl or shadows_glsl: `lit(albedo, p, n)` is how a surface looks at p,
/// relative to the projection's origin, with the normal n; `hazy(colour, p)` what the air makes of it; both
/// in linear light. `shown` is their sRGB.
extern const char* const sunlight_glsl;
/// Where nothing is in the way of the sun.
extern const char* const open_glsl;
/// Where something may be.
extern const char* const shadows_glsl;

/// The part of the ground where the shadow of a thing may fall: corner + s along + t across, s and t in [0,
/// 1], from the projection's origin. [m]
struct Shade {
  Eigen::Vector2f corner;
  Eigen::Vector2f along;
  Eigen::Vector2f across;
};

class Sunlight {
 public:
  explicit Sunlight(const Gl& gl);

  /// Chooses where in this view shadows are drawn.
  void fit(const Projection& projection, bool shadows, const Colour& sky);
  /// From now on, drawing goes into the shadow map; for what `throws_shadow`.
  void begin_shadows() const;
  void end_shadows() const;
  bool throws_shadow(const Eigen::Vector3d& p_world, double radius) const;
  /// For shaders that draw the shadow map: its clip coordinates of a point relative to the origin.
  const Eigen::Matrix4f& map_from_relative() const { return map_from_relative_; }

  /// Of what has these axes (the edges of the box around it) and this centre relative to the projection's
  /// origin, which is at `height` [m].
  Shade shade_of(const Eigen::Matrix3f& axes, const Eigen::Vector3f& centre, float height) const;

  /// Names all that sunlight_glsl needs with shadows_glsl, and with open_glsl.
  void set(const Program& program) const;
  void set_open(const Program& program) const;
  /// The haze alone, for shaders that do without the sun.
  void set_haze(const Program& program) const;

 private:
  const Gl& gl_;
  GLuint target_ = 0;
  GLuint map_ = 0;
  bool shadows_ = false;
  Colour sky_;
  float haze_ = 0.0F;            // [1/m]
  double radius_ = 0.0;          // [m] of the field with shadows
  Eigen::Vector3d p_sun_field_;  // its centre in the sun's frame [m]
  Eigen::Matrix4f map_from_relative_;
};

}  // namespace render
