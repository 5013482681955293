// The camera of each frame, and the part of the ground that it sees.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "harness/film/point_index.hpp"
#include "seif/types.hpp"
#include "sim/render/scene.hpp"
#include "worlds/world.hpp"

namespace harness {

/// What a camera is set up for.
struct CameraBrief {
  worlds::FilmCamera kind = worlds::FilmCamera::overview;
  Area subject;                          // all that an overview shows [m]
  double reach = 8.0;                    // [m] that is of interest about the robot
  double aspect = 1.0;                   // [-] width over height of the view
  Eigen::Vector3d eye = {-15, -15, 12};  // [m] of the fixed camera
  Eigen::Vector3d target = {0, 0, 0};    // [m] of the fixed camera
};

class CameraMan {
 public:
  explicit CameraMan(const CameraBrief& brief) : brief_(brief) {}

  /// The camera `step` [s] of film time after the frame before.
  render::Camera camera(const seif::Pose2& T_world_robot, double step);

 private:
  render::Camera overview() const;
  render::Camera chase(const seif::Pose2& T_world_robot, double step);
  render::Camera orbit(const seif::Pose2& T_world_robot, double step);
  render::Camera top(const seif::Pose2& T_world_robot) const;
  void follow(const seif::Pose2& T_world_robot, double step);

  CameraBrief brief_;
  bool has_followed_ = false;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();  // [m] that is followed, calmer than the robot
  double heading_ = 0.0;                                // [rad] likewise
  double film_t_ = 0.0;                                 // [s]
};

/// A camera's field of view.
class Frustum {
 public:
  Frustum(const render::Camera& camera, double aspect);

  /// Where a point that is not behind the camera lies on the image: from (-1, -1), below left, to (1, 1).
  Eigen::Vector2d on_image(const Eigen::Vector3d& p_world) const;

  /// Whether something of this size [m] about the point may be seen.
  bool sees(const Eigen::Vector3d& p_world, double radius) const;

  /// The ground that may be seen, no further than `reach` [m] from the eye's foot.
  Area ground(double reach) const;

 private:
  Eigen::Vector3d eye_;
  Eigen::Vector3d right_, up_, forward_;  // unit length
  double tan_x_, tan_y_;                  // [-] of half the field of view; orthographic: half the extent [m]
  bool is_orthographic_;
};

}  // namespace harness
