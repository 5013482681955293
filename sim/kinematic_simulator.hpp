// The world without rigid bodies. The robot follows its command exactly, within its limits. Landmarks are
// points that hide nothing and stop nothing. Meant for thousands of runs.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/simulator.hpp"
#include "worlds/point_grid.hpp"

namespace sim {

class KinematicSimulator final : public Simulator {
 public:
  /// See make_simulator. The step rate is positive.
  KinematicSimulator(const worlds::World& world, const worlds::Placement& start);

  /// The wheels roll without slip, at the speeds that the limits of speed and acceleration allow. So the robot
  /// moves on an exact circular arc.
  void step(const Command& command) override;

  void place(const worlds::Placement& T_world_robot) override;
  RobotState robot() const override;
  int add_landmark(const worlds::Landmark& landmark) override;
  void add_wall(const worlds::Wall& wall) override;
  void add_patch(const worlds::FrictionPatch& patch) override;
  void landmarks_within(const Eigen::Vector2d& p_world, double radius, std::vector<int>& out) const override;

  /// Always true.
  bool line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const override;

  /// Whether the path is clear of the landmarks' disks. Nothing would stop the robot there, but a planner that
  /// asks for a path should go around landmarks.
  bool path_is_clear(const Eigen::Vector2d& p_world_from, const Eigen::Vector2d& p_world_to,
                     double radius) const override;

  SimulatorCounts counts() const override;

 private:
  worlds::Robot robot_;
  int step_rate_;  // [Hz]
  worlds::PointGrid landmarks_;
  std::vector<double> radii_;  // [m] of the landmarks
  double largest_radius_;      // [m]
  RobotState state_;           // without its time; the heading is unwrapped
  std::int64_t steps_ = 0;     // [-]
  mutable std::int64_t candidates_ = 0;
};

}  // namespace sim
