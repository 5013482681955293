// Light of the sun and the sky, and shadows.
#pragma once

#include <Eigen/Core>

#include "sim/render/program.hpp"
#include "sim/render/projection.hpp"

namespace render {

/// GLSL, to be followed by open_glsl or shadows_glsl. `lit(albedo, p, n)` is the colour of a surface at p,
/// relative to the projection's origin, with the normal n. `hazy(colour, p)` is a colour at p after the haze of
/// the air. Both are in linear light. `shown` converts linear light to sRGB.
extern const char* const sunlight_glsl;
/// For surfaces without shadows.
extern const char* const open_glsl;
/// For surfaces on which shadows may fall.
extern const char* const shadows_glsl;

/// The part of the ground where the shadow of a thing may fall: corner + s along + t across, with s and t in
/// [0, 1], relative to the projection's origin. [m]
struct Shade {
  Eigen::Vector2f corner;
  Eigen::Vector2f along;
  Eigen::Vector2f across;
};

class Sunlight {
 public:
  explicit Sunlight(const Gl& gl);

  /// Chooses the area of this view in which shadows are drawn.
  void fit(const Projection& projection, bool shadows, const Colour& sky);
  /// From now on, drawing goes into the shadow map. Draw the things for which throws_shadow() is true.
  void begin_shadows() const;
  void end_shadows() const;
  bool throws_shadow(const Eigen::Vector3d& p_world, double radius) const;
  /// For shaders that draw the shadow map: gives its clip coordinates of a point relative to the origin.
  const Eigen::Matrix4f& map_from_relative() const { return map_from_relative_; }

  /// The shade of a thing with these axes (edges of its bounding box) and this centre, relative to the
  /// projection's origin, which is at `height` [m].
  Shade shade_of(const Eigen::Matrix3f& axes, const Eigen::Vector3f& centre, float height) const;

  /// Passes the values that sunlight_glsl needs, with shadows_glsl and with open_glsl.
  void set(const Program& program) const;
  void set_open(const Program& program) const;
  /// Passes the haze alone, for shaders without sunlight.
  void set_haze(const Program& program) const;

 private:
  const Gl& gl_;
  GLuint target_ = 0;
  GLuint map_ = 0;
  bool shadows_ = false;
  Colour sky_;
  float haze_ = 0.0F;            // [1/m]
  double radius_ = 0.0;          // [m] of the field with shadows
  Eigen::Vector3d p_sun_field_;  // centre of that field in the sun's frame [m]
  Eigen::Matrix4f map_from_relative_;
};

}  // namespace render
