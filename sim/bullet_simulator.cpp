#include "sim/bullet_simulator.hpp"

#include <stdexcept>
#include <vector>

#include "sim/drive_limits.hpp"
#include "worlds/geometry.hpp"

namespace sim {

BulletSimulator::BulletSimulator(const worlds::World& world)
    : step_rate_(world.physics.step_rate),
      footprint_radius_(worlds::footprint_radius(world.robot)),
      solids_(world),
      sensing_(solids_),
      stepped_(world.robot.mass),
      robot_(world.robot, world.physics, stepped_),
      near_solids_(solids_, sensing_, stepped_, footprint_radius_) {}

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

/// Things that were added to the solids, from this one on. Where the robot stands they cannot be.
void BulletSimulator::insert_from(int first) {
  const Eigen::Vector2d p = robot_.position();
  for (int solid = first; solid < solids_.size(); ++solid) {
    if (solids_.distance_to(solid, {p, p}) > footprint_radius_) continue;
    solids_.remove_from(first);
    throw std::invalid_argument("there is no room: the robot stands there");
  }
  for (int solid = first; solid < solids_.size(); ++solid) sensing_.insert(solid);
  near_solids_.look_again();
}

int BulletSimulator::add_landmark(const worlds::Landmark& landmark) {
  const int first = solids_.size();
  solids_.add(landmark);
  insert_from(first);
  return solids_.landmarks() - 1;
}

void BulletSimulator::add_wall(const worlds::Wall& wall) {
  const int first = solids_.size();
  solids_.add(wall);
  insert_from(first);
}

void BulletSimulator::landmarks_within(const Eigen::Vector2d& p_world, double radius,
                                       std::vector<int>& out) const {
  sensing_.landmarks_within(p_world, radius, out);
}

bool BulletSimulator::line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const {
  if (landmark < 0 || landmark >= solids_.landmarks()) {
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
