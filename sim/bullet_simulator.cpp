#include "sim/bullet_simulator.hpp"

#include <stdexcept>
#include <vector>

#include "sim/drive_limits.hpp"
#include "worlds/geometry.hpp"

namespace sim {

BulletSimulator::BulletSimulator(const worlds::World& world)
    : step_rate_(world.physics.step_rate),
      solids_(world),
      sensing_(solids_),
      stepped_(world.robot.mass),
      robot_(world.robot, world.physics, stepped_),
      near_solids_(solids_, sensing_, stepped_, worlds::footprint_radius(world.robot)) {}

void BulletSimulator::step(const Command& command) {
  const double dt = 1.0 / step_rate_;
  robot_.drive(command, dt);
  near_solids_.follow(robot_.position());
  stepped_.step(dt);
  robot_.read_joints();
  ++steps_;
  objects_stepped_ += stepped_.objects();
}

void BulletSimulator::place(const worlds::Placement& T_world_robot) {
  check_place(T_world_robot);
  robot_.place(T_world_robot);
}

RobotState BulletSimulator::robot() const {
  RobotState state = robot_.state();
  state.t = static_cast<double>(steps_) / step_rate_;  // not a sum, so rounding does not accumulate
  return state;
}

void BulletSimulator::landmarks_within(const Eigen::Vector2d& p_world, double radius,
                                       std::vector<int>& out) const {
  sensing_.landmarks_within(p_world, radius, out);
}

bool BulletSimulator::line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const {
  if (landmark < 0 || landmark >= solids_.size() || !solids_.is_landmark(landmark)) {
    throw std::out_of_range("simulator: there is no landmark of that index");
  }
  return sensing_.line_of_sight(p_world_sensor, landmark);
}

bool BulletSimulator::path_is_clear(const Eigen::Vector2d& p_world_from, const Eigen::Vector2d& p_world_to,
                                    double radius) const {
  return sensing_.path_is_clear({p_world_from, p_world_to}, radius);
}

SimulatorCounts BulletSimulator::counts() const {
  const QueryCounts& queries = sensing_.counts();
  return {steps_, objects_stepped_, queries.rays, queries.candidates};
}

}  // namespace sim
