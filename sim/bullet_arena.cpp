#include "sim/bullet_arena.hpp"

#include <stdexcept>

#include "worlds/geometry.hpp"

namespace sim {

BulletArena::BulletArena(const worlds::World& world, std::span<const worlds::Placement> starts)
    : step_rate_(world.physics.step_rate),
      footprint_radius_(worlds::footprint_radius(world.robot)),
      footprint_(worlds::footprint(world.robot)),
      solids_(world),
      sensing_(solids_),
      stepped_(world.robot.mass, starts.size()),
      near_solids_(solids_, sensing_, stepped_, footprint_radius_) {
  for (const worlds::Placement& start : starts) {
    worlds::Robot robot = world.robot;
    robot.start = start;
    robots_.emplace_back(robot, world.physics, stepped_);
  }
  positions_.resize(robots_.size());
}

/// A robot hears its command when it is told, so the order in which they are told does not matter.
void BulletArena::command(std::size_t robot, const Command& command) {
  robots_[robot].drive(command, 1.0 / step_rate_);
  if (++told_ < robots_.size()) return;
  told_ = 0;
  step();
}

void BulletArena::step() {
  for (std::size_t i = 0; i < robots_.size(); ++i) positions_[i] = robots_[i].position();
  near_solids_.follow(positions_);
  stepped_.step(1.0 / step_rate_);
  for (RobotBody& robot : robots_) robot.read_joints();
  ++steps_;
  objects_stepped_ += stepped_.objects();
}

void BulletArena::place(std::size_t robot, const worlds::Placement& T_world_robot) {
  robots_[robot].place(T_world_robot);
}

RobotState BulletArena::state(std::size_t robot) const {
  RobotState state = robots_[robot].state();
  state.t = static_cast<double>(steps_) / step_rate_;  // not a sum, so rounding does not accumulate
  return state;
}

/// Things that were added to the solids, from this one on. Where a robot stands they cannot be.
void BulletArena::insert_from(int first) {
  for (const RobotBody& robot : robots_) {
    const Eigen::Vector2d p = robot.position();
    for (int solid = first; solid < solids_.size(); ++solid) {
      if (solids_.distance_to(solid, {p, p}) > footprint_radius_) continue;
      solids_.remove_from(first);
      throw std::invalid_argument("there is no room: the robot stands there");
    }
  }
  for (int solid = first; solid < solids_.size(); ++solid) sensing_.insert(solid);
  near_solids_.look_again();
}

int BulletArena::add_landmark(const worlds::Landmark& landmark) {
  const int first = solids_.size();
  solids_.add(landmark);
  insert_from(first);
  return solids_.landmarks() - 1;
}

void BulletArena::add_wall(const worlds::Wall& wall) {
  const int first = solids_.size();
  solids_.add(wall);
  insert_from(first);
}

void BulletArena::add_patch(const worlds::FrictionPatch& patch) {
  for (RobotBody& robot : robots_) robot.add_patch(patch);
}

Rectangle BulletArena::chassis(std::size_t robot) const {
  const RobotState state = robots_[robot].state();
  const Eigen::Vector2d p_robot_middle = 0.5 * (footprint_.min + footprint_.max);
  const Eigen::Vector2d forward = direction(state.heading);
  const Eigen::Vector2d left(-forward.y(), forward.x());
  return {state.position + p_robot_middle.x() * forward + p_robot_middle.y() * left, state.heading,
          0.5 * (footprint_.max - footprint_.min)};
}

bool BulletArena::is_clear_of_others(std::size_t robot, const Segment& way, double radius) const {
  for (std::size_t other = 0; other < robots_.size(); ++other) {
    if (other != robot && distance(way, chassis(other)) <= radius) return false;
  }
  return true;
}

SimulatorCounts BulletArena::counts() const {
  const QueryCounts& queries = sensing_.counts();
  return {steps_, objects_stepped_, queries.rays, queries.candidates};
}

}  // namespace sim
