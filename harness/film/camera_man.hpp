// Places the camera in each frame, and says which part of the ground it sees.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "harness/film/point_index.hpp"
#include "seif/types.hpp"
#include "sim/render/scene.hpp"
#include "worlds/world.hpp"

namespace harness {

/// What a camera is to show.
struct CameraBrief {
  worlds::FilmCamera kind = worlds::FilmCamera::overview;
  Area subject;                          // [m] what an overview shows in full
  double reach = 8.0;                    // [m] radius of interest around the robot
  double aspect = 1.0;                   // [-] width over height of the view
  Eigen::Vector3d eye = {-15, -15, 12};  // [m] position of the fixed camera
  Eigen::Vector3d target = {0, 0, 0};    // [m] point that the fixed camera looks at
};

class CameraMan {
 public:
  explicit CameraMan(const CameraBrief& brief) : brief_(brief) {}

  /// The camera of the next frame, `step` [s] of film time after the last one.
  render::Camera camera(const seif::Pose2& T_world_robot, double step);

 private:
  render::Camera overview() const;
  render::Camera overview_from(double elevation) const;
  render::Camera chase(const seif::Pose2& T_world_robot, double step);
  render::Camera orbit(const seif::Pose2& T_world_robot, double step);
  render::Camera top(const seif::Pose2& T_world_robot) const;
  void follow(const seif::Pose2& T_world_robot, double step);

  CameraBrief brief_;
  std::optional<render::Camera> overview_;  // always the same
  bool has_followed_ = false;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();  // [m] point to follow: the robot's position, smoothed
  double heading_ = 0.0;                                // [rad] the robot's heading, smoothed
  double film_t_ = 0.0;                                 // [s]
};

/// A camera's field of view.
class Frustum {
 public:
  Frustum(const render::Camera& camera, double aspect);

  /// How long a metre at this point is on an image of height 1. [1/m]
  double image_heights_per_metre(const Eigen::Vector3d& p_world) const;

  /// The position on the image of a point in front of the camera, from (-1, -1), lower left, to (1, 1).
  Eigen::Vector2d on_image(const Eigen::Vector3d& p_world) const;

  /// True if a sphere of this radius [m] about the point may be in view.
  bool sees(const Eigen::Vector3d& p_world, double radius) const;

  /// The ground that may be in view, at most `reach` [m] from the point below the eye.
  Area ground(double reach) const;

 private:
  Eigen::Vector3d eye_;
  Eigen::Vector3d right_, up_, forward_;  // unit length
  double tan_x_, tan_y_;                  // [-] of half the field of view; orthographic: half the extent [m]
  bool is_orthographic_;
};

}  // namespace harness
