// The landmark sensor in a film: its range and field of view, and the rays of the latest scan.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "harness/film/stage.hpp"
#include "harness/stream/stream.hpp"
#include "sim/render/scene.hpp"
#include "sim/simulator.hpp"
#include "worlds/world.hpp"

namespace harness {

class Sight {
 public:
  enum class Kind { seen, hidden, false_detection };
  struct Ray {
    Eigen::Vector2d end;  // p_world [m]
    Kind kind;
  };

  /// `knows_world`: also find the landmarks that something hides; their lines of sight are tested in the
  /// world.
  Sight(const worlds::World& world, bool knows_world, const seif::Pose2& T_robot_sensor);

  /// Takes in a scan. `T_world_robot` is the true pose, or the best known one.
  void scan(const ScanEvent& event, const seif::Pose2& T_world_robot, const Stage& stage);

  /// Appends rays from the robot's present position to what the latest scan found.
  void append_rays(const seif::Pose2& T_world_robot, double height, float scale,
                   render::Things& things) const;
  void append_range(const seif::Pose2& T_world_robot, float scale, render::Things& things) const;

  /// The rays of the latest scan.
  const std::vector<Ray>& rays() const { return rays_; }

 private:
  void find_hidden(const seif::Pose2& T_world_sensor);

  worlds::LandmarkSensor sensor_;
  std::vector<worlds::Landmark> landmarks_;    // sorted by id; empty if the world is not known
  std::unique_ptr<sim::Simulator> simulator_;  // null if the world is not known
  seif::Pose2 T_robot_sensor_;
  std::vector<Ray> rays_;
  std::vector<seif::LandmarkId> seen_;  // reused
  std::vector<int> in_range_;           // reused
};

}  // namespace harness
