// The world of a film: ground, walls, landmarks as they are, and the robot.
#pragma once

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
  /// `knows_world`: the run came from this world file; otherwise only the robot's defaults are taken from it,
  /// and what there is to see comes from the log.
  Stage(const worlds::World& world, bool knows_world, const LogDescription& log);

  /// What an overview must show. [m]
  const Area& subject() const { return subject_; }
  /// What is of interest about the robot. [m]
  double reach() const { return reach_; }
  render::Ground ground(bool with_grid) const;

  /// Walls, boxes and landmarks that a camera sees.
  void append_surroundings(const Frustum& frustum, const Area& area, render::Things& things);

  void append_robot(const TruePose& pose, render::Things& things) const;

  /// p_world_landmark, where it is known. [m]
  std::optional<Eigen::Vector2d> true_position(seif::LandmarkId id) const { return posts_.position(id); }
  /// How high rays are drawn. [m]
  double sensor_height() const { return 2.2 * robot_.wheel_radius; }

 private:
  void add_solids(const worlds::World& world);
  double radius(seif::LandmarkId id) const;

  worlds::Robot robot_;
  Eigen::Vector2d ground_size_;                           // [m]
  double reach_;                                          // [m]
  Area subject_;                                          // [m]
  std::vector<render::Solid> solids_;                     // walls and boxes
  const std::vector<TrueLandmark>* landmarks_ = nullptr;  // by ascending id; null: not known
  PointIndex posts_{4.0};
  std::vector<seif::LandmarkId> in_area_;  // reused
};

}  // namespace harness
