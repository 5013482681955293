#include "harness/film/camera_man.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace harness {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double field_of_view = 0.75;  // [rad] vertical
constexpr double filled = 0.94;         // [-] of the view, by the subject of an overview
constexpr double calm = 0.6;            // [s] time constant of following, in film time

Vector3d on_ground(const Vector2d& p) { return {p.x(), p.y(), 0.0}; }

Vector2d direction(double heading) { return {std::cos(heading), std::sin(heading)}; }

/// The part of the image, from -1 to 1, that the subject covers.
struct Extent {
  Vector2d min = Vector2d::Constant(INFINITY);
  Vector2d max = Vector2d::Constant(-INFINITY);
};

Extent extent_on(const Frustum& frustum, const Area& subject) {
  Extent extent;
  for (const double x : {subject.min.x(), subject.max.x()}) {
    for (const double y : {subject.min.y(), subject.max.y()}) {
      const Vector2d p = frustum.on_image({x, y, 0.0});
      extent.min = extent.min.cwiseMin(p);
      extent.max = extent.max.cwiseMax(p);
    }
  }
  return extent;
}

/// The smallest number between two limits for which a condition holds. The condition holds for all larger
/// numbers too.
template <class Condition>
double bisect(double from, double to, const Condition& holds, int steps = 40) {
  for (int i = 0; i < steps; ++i) {
    const double middle = 0.5 * (from + to);
    (holds(middle) ? to : from) = middle;
  }
  return to;
}

}  // namespace

render::Camera CameraMan::camera(const seif::Pose2& T_world_robot, double step) {
  film_t_ += step;
  switch (brief_.kind) {
    case worlds::FilmCamera::overview:
      if (!overview_) overview_ = overview();
      return *overview_;
    case worlds::FilmCamera::chase:
      return chase(T_world_robot, step);
    case worlds::FilmCamera::orbit:
      return orbit(T_world_robot, step);
    case worlds::FilmCamera::top:
      return top(T_world_robot);
    case worlds::FilmCamera::fixed:
      break;
  }
  render::Camera camera;
  camera.eye = brief_.eye;
  camera.target = brief_.target;
  camera.field_of_view = field_of_view;
  const Vector3d line = (camera.target - camera.eye).normalized();
  if (std::abs(line.z()) > 0.999) camera.up = Vector3d::UnitY();
  return camera;
}

/// The camera stands in the south, high up. It is just far enough away for all corners to be in view, and the
/// margins above and below the subject are equal.
render::Camera CameraMan::overview_from(double elevation) const {
  const Vector3d line(0.0, std::cos(elevation), -std::sin(elevation));
  const Vector2d middle = 0.5 * (brief_.subject.min + brief_.subject.max);
  const double diagonal = (brief_.subject.max - brief_.subject.min).norm();
  const auto camera_at = [&](double distance, double shift) {
    render::Camera camera;
    camera.field_of_view = field_of_view;
    camera.target = on_ground(middle) + Vector3d(0.0, shift, 0.0);
    camera.eye = camera.target - distance * line;
    return camera;
  };
  const auto extent_at = [&](double distance, double shift) {
    return extent_on(Frustum(camera_at(distance, shift), brief_.aspect), brief_.subject);
  };
  const auto shift_for = [&](double distance) {
    return bisect(-0.5 * diagonal, 0.5 * diagonal, [&](double shift) {
      const Extent extent = extent_at(distance, shift);
      return extent.max.y() + extent.min.y() < 0.0;  // too low on the image: the camera aims too far
    });
  };
  // Nearer than half a diagonal, some corners may lie behind the camera.
  const double distance = bisect(0.5 * diagonal, 20.0 * diagonal, [&](double tried) {
    const Extent extent = extent_at(tried, shift_for(tried));
    return extent.min.minCoeff() >= -filled && extent.max.maxCoeff() <= filled;
  });
  return camera_at(distance, shift_for(distance));
}

/// The camera looks down steeply enough for a wide subject to fill the height of the view too, but never
/// straight down: walls and posts must show their sides.
render::Camera CameraMan::overview() const {
  constexpr double lowest = 0.9;   // [rad]
  constexpr double highest = 1.3;  // [rad]
  constexpr double tall = 1.64;    // [-] of 2: the titles have their place above the subject
  const double elevation = bisect(
      lowest, highest,
      [&](double tried) {
        const Extent extent = extent_on(Frustum(overview_from(tried), brief_.aspect), brief_.subject);
        return extent.max.y() - extent.min.y() >= tall;
      },
      10);
  return overview_from(elevation);
}

/// Moves the followed point towards the robot, with a time constant in film time.
void CameraMan::follow(const seif::Pose2& T_world_robot, double step) {
  const Vector2d p(T_world_robot.x, T_world_robot.y);
  if (!has_followed_) {
    has_followed_ = true;
    position_ = p;
    heading_ = T_world_robot.theta;
    return;
  }
  const double share = 1.0 - std::exp(-step / calm);
  position_ += std::min(1.0, 3.0 * share) * (p - position_);
  heading_ += share * seif::wrap_angle(T_world_robot.theta - heading_);
}

render::Camera CameraMan::chase(const seif::Pose2& T_world_robot, double step) {
  follow(T_world_robot, step);
  render::Camera camera;
  camera.field_of_view = field_of_view;
  camera.eye = on_ground(position_ - 0.65 * brief_.reach * direction(heading_));
  camera.eye.z() = 0.5 * brief_.reach;
  camera.target = on_ground(position_ + 0.3 * brief_.reach * direction(heading_));
  return camera;
}

render::Camera CameraMan::orbit(const seif::Pose2& T_world_robot, double step) {
  constexpr double period = 30.0;  // [s] of film time
  follow(T_world_robot, step);
  const double angle = 2.0 * std::numbers::pi * film_t_ / period;
  render::Camera camera;
  camera.field_of_view = field_of_view;
  camera.eye = on_ground(position_ - 1.3 * brief_.reach * direction(angle));
  camera.eye.z() = 0.9 * brief_.reach;
  camera.target = on_ground(position_);
  return camera;
}

render::Camera CameraMan::top(const seif::Pose2& T_world_robot) const {
  const double height = 3.0 * brief_.reach;
  render::Camera camera;
  camera.target = {T_world_robot.x, T_world_robot.y, 0.0};
  camera.eye = camera.target + Vector3d(0.0, 0.0, height);
  camera.up = Vector3d::UnitY();
  camera.height = height / std::min(1.0, brief_.aspect);
  return camera;
}

Frustum::Frustum(const render::Camera& camera, double aspect)
    : eye_(camera.eye),
      forward_((camera.target - camera.eye).normalized()),
      tan_y_(camera.height > 0.0 ? 0.5 * camera.height : std::tan(0.5 * camera.field_of_view)),
      is_orthographic_(camera.height > 0.0) {
  right_ = forward_.cross(camera.up).normalized();
  up_ = right_.cross(forward_);
  tan_x_ = tan_y_ * aspect;
}

Vector2d Frustum::on_image(const Eigen::Vector3d& p_world) const {
  const Vector3d d = p_world - eye_;
  const double depth = is_orthographic_ ? 1.0 : d.dot(forward_);
  return {d.dot(right_) / (depth * tan_x_), d.dot(up_) / (depth * tan_y_)};
}

double Frustum::image_heights_per_metre(const Eigen::Vector3d& p_world) const {
  const double depth = is_orthographic_ ? 1.0 : std::max((p_world - eye_).dot(forward_), 1e-3);
  return 0.5 / (depth * tan_y_);
}

bool Frustum::sees(const Eigen::Vector3d& p_world, double radius) const {
  const Vector3d d = p_world - eye_;
  const double depth = is_orthographic_ ? 1.0 : d.dot(forward_);
  // The sides of a wide field of view are oblique, so a sphere reaches further into it than its radius.
  const double margin = radius * (is_orthographic_ ? 1.0 : std::hypot(1.0, std::max(tan_x_, tan_y_)));
  return depth > -radius && std::abs(d.dot(right_)) <= depth * tan_x_ + margin &&
         std::abs(d.dot(up_)) <= depth * tan_y_ + margin;
}

Area Frustum::ground(double reach) const {
  const Vector2d foot = eye_.head<2>();
  Area area{foot, foot};
  bool is_first = true;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vector3d across = x * tan_x_ * right_ + y * tan_y_ * up_;
      const Vector3d start = is_orthographic_ ? Vector3d(eye_ + across) : eye_;
      const Vector3d ray = is_orthographic_ ? forward_ : Vector3d(forward_ + across);
      Vector2d p = start.head<2>();
      const double horizontal = ray.head<2>().norm();
      double along = ray.z() < 0.0 ? -start.z() / ray.z() : INFINITY;
      if (horizontal > 0.0) along = std::min(along, reach / horizontal);
      if (std::isfinite(along)) p += along * ray.head<2>();
      area.min = is_first ? p : Vector2d(area.min.cwiseMin(p));
      area.max = is_first ? p : Vector2d(area.max.cwiseMax(p));
      is_first = false;
    }
  }
  return area;
}

}  // namespace harness
