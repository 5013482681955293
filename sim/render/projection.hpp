// A camera at work: where on the image the points of the world are. Pixels count from the lower left corner
// of the view, as OpenGL has them.
#pragma once

#include <Eigen/Core>

#include "sim/render/scene.hpp"

namespace render {

class Projection {
 public:
  /// [px] the size of the view.
  Projection(const Camera& camera, int width, int height);

  /// [m] shaders get what is relative to this point, in single precision: near it a rounding error is smaller
  /// than a pixel, however far from the world's origin it is.
  const Eigen::Vector3d& origin() const { return origin_; }

  /// For shaders: OpenGL's clip coordinates of a point relative to the origin.
  Eigen::Matrix4f clip_from_relative() const;

  /// (x w, y w, z w, w) with x and y in pixels and z the depth of a mark, [-1, 1], a little nearer than the
  /// point so that it shows on a surface that it lies on. Linear, as is homogeneous_direction.
  Eigen::Vector4d homogeneous(const Eigen::Vector3d& p_world) const;
  Eigen::Vector4d homogeneous_direction(const Eigen::Vector3d& direction) const;
  /// What has a smaller w lies behind the camera.
  double nearest() const { return perspective_ ? near_ : 0.5; }

  /// [-] whether a ball may be in the view.
  bool sees(const Eigen::Vector3d& p_world, double radius) const;
  /// How long a metre is there, across the line of sight. [px]
  double pixels_per_metre(const Eigen::Vector3d& p_world) const;

  /// The point relative to the origin that a pixel (x, y, 1) sees is start + t direction.
  Eigen::Matrix3f ray_start() const;
  Eigen::Matrix3f ray_direction() const;

  bool perspective() const { return perspective_; }
  /// [m] from the eye to the target.
  double distance() const { return distance_; }
  /// p_world [m], radius [m]: where shadows are worth the while.
  const Eigen::Vector3d& field_centre() const { return field_centre_; }
  double field_radius() const { return field_radius_; }

 private:
  Eigen::Vector3d in_view(const Eigen::Vector3d& p_world) const;

  Eigen::Vector2d size_;  // [px]
  bool perspective_;
  double distance_;          // [m]
  double near_;              // [m] perspective: the nearest depth
  double depth_reach_;       // [m] otherwise: what is farther than this from the target's depth is cut off
  Eigen::Vector2d tangent_;  // [-] of half the field of view; [m] half the field itself without perspective
  Eigen::Matrix3d R_view_world_;  // x to the right, y up, z towards the camera
  Eigen::Vector3d origin_;
  Eigen::Matrix4d pixel_from_relative_;
  Eigen::Vector3d field_centre_;
  double field_radius_;
};

}  // namespace render
