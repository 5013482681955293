#include "sim/render/projection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace render {

namespace {

// Fractions of the distance: how much nearer a mark is drawn, and how near the nearest visible thing may be.
constexpr double mark_lift = 0.0015;
constexpr double nearest_share = 0.02;

Eigen::Matrix3d view_rotation(const Camera& camera) {
  const Eigen::Vector3d back = (camera.eye - camera.target).normalized();
  const Eigen::Vector3d right = camera.up.cross(back);
  if (!(right.norm() > 1e-9)) throw std::invalid_argument("a camera's up lies along its line of sight");
  Eigen::Matrix3d R;
  R.row(0) = right.normalized();
  R.row(1) = back.cross(right).normalized();
  R.row(2) = back;
  return R;
}

}  // namespace

Projection::Projection(const Camera& camera, int width, int height)
    : size_(width, height),
      perspective_(camera.height <= 0.0),
      distance_((camera.eye - camera.target).norm()),
      near_(nearest_share * distance_),
      depth_reach_(2.0 * (distance_ + camera.height)),
      R_view_world_(view_rotation(camera)),
      origin_(perspective_ ? camera.eye : camera.target) {
  const double half = perspective_ ? std::tan(0.5 * camera.field_of_view) : 0.5 * camera.height;
  tangent_ = {half * size_.x() / size_.y(), half};
  const Eigen::Matrix3d& R = R_view_world_;
  Eigen::Matrix4d& M = pixel_from_relative_;
  M.setZero();
  const double lifted = 1.0 - mark_lift;
  if (perspective_) {
    M.row(3).head<3>() = -R.row(2);  // w is the depth
    M.row(2) = M.row(3) - Eigen::RowVector4d(0.0, 0.0, 0.0, 2.0 * near_ / lifted);
  } else {
    M(3, 3) = 1.0;
    M.row(2).head<3>() = -R.row(2) / depth_reach_;
    M(2, 3) = -mark_lift * camera.height / depth_reach_;
  }
  for (int axis = 0; axis < 2; ++axis) {
    const double half_size = 0.5 * size_(axis);
    M.row(axis).head<3>() = half_size / tangent_(axis) * R.row(axis);
    M.row(axis) += half_size * M.row(3);
  }
  // In perspective, the area reaches from the lower edge of the image to well behind the target.
  Eigen::Vector3d ahead = camera.target - camera.eye;
  ahead.z() = 0.0;
  field_centre_ = perspective_ ? Eigen::Vector3d(camera.target + 0.4 * ahead) : camera.target;
  field_radius_ = perspective_ ? 1.4 * distance_ : 1.1 * tangent_.norm();
}

Eigen::Matrix4f Projection::clip_from_relative() const {
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip.row(3) = pixel_from_relative_.row(3);
  for (int axis = 0; axis < 2; ++axis) clip.row(axis).head<3>() = R_view_world_.row(axis) / tangent_(axis);
  if (perspective_) {
    clip.row(2) = clip.row(3) - Eigen::RowVector4d(0.0, 0.0, 0.0, 2.0 * near_);
  } else {
    clip.row(2).head<3>() = -R_view_world_.row(2) / depth_reach_;
  }
  return clip.cast<float>();
}

Eigen::Vector4d Projection::homogeneous(const Eigen::Vector3d& p_world) const {
  return pixel_from_relative_ * (p_world - origin_).homogeneous();
}

Eigen::Vector4d Projection::homogeneous_direction(const Eigen::Vector3d& direction) const {
  return pixel_from_relative_.leftCols<3>() * direction;
}

Eigen::Vector3d Projection::in_view(const Eigen::Vector3d& p_world) const {
  return R_view_world_ * (p_world - origin_);
}

bool Projection::sees(const Eigen::Vector3d& p_world, double radius) const {
  const Eigen::Vector3d p = in_view(p_world);
  if (perspective_ && -p.z() < -radius) return false;
  for (int axis = 0; axis < 2; ++axis) {
    const double half = perspective_ ? -p.z() * tangent_(axis) : tangent_(axis);
    const double slant = perspective_ ? std::hypot(1.0, tangent_(axis)) : 1.0;
    if (std::abs(p(axis)) > half + radius * slant) return false;
  }
  return true;
}

double Projection::pixels_per_metre(const Eigen::Vector3d& p_world) const {
  const double depth = perspective_ ? std::max(near_, -in_view(p_world).z()) : 1.0;
  return 0.5 * size_.y() / (tangent_.y() * depth);
}

Eigen::Matrix3f Projection::ray_start() const {
  if (perspective_) return Eigen::Matrix3f::Zero();
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector3d across = R_view_world_.row(axis) * tangent_(axis);
    S.col(axis) = 2.0 / size_(axis) * across;
    S.col(2) -= across;
  }
  return S.cast<float>();
}

Eigen::Matrix3f Projection::ray_direction() const {
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();
  D.col(2) = -R_view_world_.row(2);
  for (int axis = 0; perspective_ && axis < 2; ++axis) {
    const Eigen::Vector3d across = R_view_world_.row(axis) * tangent_(axis);
    D.col(axis) = 2.0 / size_(axis) * across;
    D.col(2) -= across;
  }
  return D.cast<float>();
}

}  // namespace render
