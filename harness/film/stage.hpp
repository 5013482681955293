// The world in a film: ground, walls, true landmarks, and the robot.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "harness/film/camera_man.hpp"
#include "harness/film/point_index.hpp"
#include "harness/stream/log_description.hpp"
#include "harness/stream/stream.hpp"
#include "sim/render/scene.hpp"
#include "worlds/world.hpp"

namespace harness {

class Stage {
 public:
  /// `knows_world`: the run came from this world file. Otherwise only the default robot is taken from
  /// `world`, and the rest comes from the log.
  /// `path`: the area of the path while the film lasts; empty if not known. [m]
  Stage(const worlds::World& world, bool knows_world, const LogDescription& log,
        const std::optional<Area>& path);

  /// A landmark that joins the log's landmarks during the run, or has another id now.
  void put_landmark(const TrueLandmark& landmark) { posts_.put(landmark.landmark, landmark.position); }

  /// What has appeared in the world up to `t` [s] is shown from now on. Times must not decrease.
  void let_appear(double t);

  /// What an overview shows in full. [m]
  const Area& subject() const { return subject_; }
  /// The radius of interest around the robot. [m]
  double reach() const { return reach_; }
  render::Ground ground(bool with_grid) const;

  /// Appends the walls, boxes and landmarks that the camera sees.
  void append_surroundings(const Frustum& frustum, const Area& area, render::Things& things);

  /// Appends the robot, `size` times as large as it is.
  void append_robot(const TruePose& pose, double size, render::Things& things) const;
  /// The length of the robot. [m]
  double robot_length() const;

  /// Walls, boxes, and ground with a friction of its own.
  const std::vector<render::Solid>& solids() const { return solids_; }

  /// The true position p_world_landmark; empty if it is not known. [m]
  std::optional<Eigen::Vector2d> true_position(seif::LandmarkId id) const { return posts_.position(id); }
  /// Height at which rays are drawn. [m]
  double sensor_height() const { return 2.2 * robot_.wheel_radius; }

 private:
  void add_solids(const worlds::World& world);
  void add_patch(const worlds::FrictionPatch& patch);
  void add_wall(const worlds::Wall& wall);
  double radius(seif::LandmarkId id) const;

  worlds::Robot robot_;
  Eigen::Vector2d ground_size_;                           // [m]
  double reach_;                                          // [m]
  Area subject_;                                          // [m]
  std::vector<render::Solid> solids_;                     // walls and boxes
  std::vector<worlds::Fault> to_come_;                    // ice, walls and landmarks, the latest first
  std::size_t landmarks_shown_ = 0;                       // [-] of `landmarks_`: those that are there
  const std::vector<TrueLandmark>* landmarks_ = nullptr;  // sorted by id; null: not known
  PointIndex posts_{4.0};
  std::vector<seif::LandmarkId> in_area_;  // reused
};

}  // namespace harness
