// What the landmark sensor sees: its range and field of view, and the rays of the latest scan.
#pragma once

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
  /// `knows_world`: the world is asked for lines of sight, to find hidden landmarks.
  Sight(const worlds::World& world, bool knows_world, const seif::Pose2& T_robot_sensor);

  /// `T_world_robot`: the true pose, or the best that is known.
  void scan(const ScanEvent& event, const seif::Pose2& T_world_robot, const Stage& stage);

  /// Rays from the robot's present position to what the latest scan saw.
  void append_rays(const seif::Pose2& T_world_robot, double height, float scale,
                   render::Things& things) const;
  void append_range(const seif::Pose2& T_world_robot, float scale, render::Things& things) const;

 private:
  enum class Kind { seen, hidden, false_detection };
  struct Ray {
    Eigen::Vector2d end;  // p_world [m]
    Kind kind;
  };

  void find_hidden(const seif::Pose2& T_world_sensor);

  worlds::LandmarkSensor sensor_;
  std::vector<worlds::Landmark> landmarks_;    // by id; none if the world is not known
  std::unique_ptr<sim::Simulator> simulator_;  // likewise
  seif::Pose2 T_robot_sensor_;
  std::vector<Ray> rays_;
  std::vector<seif::LandmarkId> seen_;  // reused
  std::vector<int> in_range_;           // reused
};

}  // namespace harness
