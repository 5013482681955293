// Projects points of the world onto the image of a camera. Pixels count from the lower left corner of the view,
// as in OpenGL.
#pragma once

#include <Eigen/Core>

#include "sim/render/scene.hpp"

namespace render {

class Projection {
 public:
  /// `width`, `height`: the size of the view. [px]
  Projection(const Camera& camera, int width, int height);

  /// [m] Shaders get positions relative to this point, in single precision. Near this point a rounding error is
  /// smaller than a pixel, however far it is from the world's origin.
  const Eigen::Vector3d& origin() const { return origin_; }

  /// For shaders: gives OpenGL's clip coordinates of a point relative to the origin.
  Eigen::Matrix4f clip_from_relative() const;

  /// (x w, y w, z w, w) with x and y in pixels, and z in [-1, 1] the depth of a mark. A mark is a little nearer
  /// than its point, so that it shows on a surface that it lies on. The map is linear, as is
  /// homogeneous_direction.
  Eigen::Vector4d homogeneous(const Eigen::Vector3d& p_world) const;
  Eigen::Vector4d homogeneous_direction(const Eigen::Vector3d& direction) const;
  /// A point with a smaller w is behind the camera.
  double nearest() const { return perspective_ ? near_ : 0.5; }

  /// Whether a ball may be in the view.
  bool sees(const Eigen::Vector3d& p_world, double radius) const;
  /// The length of a metre at this point, across the line of sight. [px]
  double pixels_per_metre(const Eigen::Vector3d& p_world) const;

  /// A pixel (x, y, 1) sees the points start + t direction, relative to the origin.
  Eigen::Matrix3f ray_start() const;
  Eigen::Matrix3f ray_direction() const;

  bool perspective() const { return perspective_; }
  /// [m] from the eye to the target.
  double distance() const { return distance_; }
  /// The area in which shadows are drawn: centre p_world [m] and radius [m].
  const Eigen::Vector3d& field_centre() const { return field_centre_; }
  double field_radius() const { return field_radius_; }

 private:
  Eigen::Vector3d in_view(const Eigen::Vector3d& p_world) const;

  Eigen::Vector2d size_;  // [px]
  bool perspective_;
  double distance_;               // [m]
  double near_;                   // [m] perspective: the least visible depth
  double depth_reach_;            // [m] no perspective: visible depths around the target's depth
  Eigen::Vector2d tangent_;       // [-] of half the field of view; no perspective: half the field [m]
  Eigen::Matrix3d R_view_world_;  // x to the right, y up, z towards the camera
  Eigen::Vector3d origin_;
  Eigen::Matrix4d pixel_from_relative_;
  Eigen::Vector3d field_centre_;
  double field_radius_;
};

}  // namespace render
