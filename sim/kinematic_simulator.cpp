#include "sim/kinematic_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sim/drive_limits.hpp"
#include "sim/planar_geometry.hpp"
#include "worlds/geometry.hpp"

namespace sim {

namespace {

/// The edge of the grid's cells [m]. A scan examines nine cells. The edge is at least 1 m, even for a sensor of
/// very short range, so that a path does not cross thousands of cells.
double grid_cell(const worlds::World& world) {
  return std::max({1.0, world.landmark_sensor.max_range, worlds::largest_radius(world.landmarks)});
}

}  // namespace

KinematicSimulator::KinematicSimulator(const worlds::World& world, const worlds::Placement& start)
    : robot_(world.robot),
      step_rate_(world.physics.step_rate),
      landmarks_(grid_cell(world)),
      largest_radius_(worlds::largest_radius(world.landmarks)) {
  check_drive(robot_);
  if (!world.boxes.empty() || !world.walls.empty() || !world.physics.patches.empty()) {
    throw std::invalid_argument("simulator: the kinematic engine knows no obstacles and no friction");
  }
  radii_.reserve(world.landmarks.size());
  for (const worlds::Landmark& landmark : world.landmarks) {
    landmarks_.add(landmark.position);
    radii_.push_back(landmark.radius);
  }
  state_.position = start.position;
  state_.heading = start.heading;
}

void KinematicSimulator::step(const Command& command) {
  const double dt = 1.0 / step_rate_;
  const Command driven = limited(command, {state_.v, state_.omega}, robot_, dt);
  const WheelSpeeds speeds = wheel_speeds(driven, robot_);
  // At its start, the chord of the arc deviates from the heading by half the turn.
  const double half_turn = 0.5 * driven.omega * dt;
  const double chord = driven.v * dt * (half_turn == 0.0 ? 1.0 : std::sin(half_turn) / half_turn);
  state_.position += chord * direction(state_.heading + half_turn);
  state_.heading += 2.0 * half_turn;
  state_.left_wheel += speeds.left * dt;
  state_.right_wheel += speeds.right * dt;
  state_.v = driven.v;
  state_.omega = driven.omega;
  ++steps_;
}

void KinematicSimulator::place(const worlds::Placement& T_world_robot) {
  check_place(T_world_robot);
  state_.position = T_world_robot.position;
  state_.heading = T_world_robot.heading;
}

RobotState KinematicSimulator::robot() const {
  RobotState state = state_;
  state.heading = heading_of(direction(state_.heading));
  state.t = static_cast<double>(steps_) / step_rate_;
  return state;
}

int KinematicSimulator::add_landmark(const worlds::Landmark& landmark) {
  if (!(landmark.radius > 0.0)) {
    throw std::invalid_argument("simulator: a landmark's radius must be positive");
  }
  const double distance_to_robot = (landmark.position - state_.position).norm() - landmark.radius;
  if (!(distance_to_robot > worlds::footprint_radius(robot_))) {
    throw std::invalid_argument("there is no room: the robot stands there");
  }
  landmarks_.add(landmark.position);
  radii_.push_back(landmark.radius);
  largest_radius_ = std::max(largest_radius_, landmark.radius);
  return static_cast<int>(radii_.size()) - 1;
}

void KinematicSimulator::add_wall(const worlds::Wall&) {
  throw std::invalid_argument("simulator: the kinematic engine knows no walls");
}

void KinematicSimulator::add_patch(const worlds::FrictionPatch&) {
  throw std::invalid_argument("simulator: the kinematic engine knows no friction");
}

void KinematicSimulator::landmarks_within(const Eigen::Vector2d& p_world, double radius,
                                          std::vector<int>& out) const {
  out.clear();
  landmarks_.any_within(p_world, radius, [&](std::size_t landmark, const Eigen::Vector2d& p_world_landmark) {
    ++candidates_;
    if ((p_world_landmark - p_world).norm() <= radius) {
      out.push_back(static_cast<int>(landmark));
    }
    return false;
  });
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());  // the grid may report a point twice
}

bool KinematicSimulator::line_of_sight(const Eigen::Vector2d&, int landmark) const {
  if (landmark < 0 || static_cast<std::size_t>(landmark) >= radii_.size()) {
    throw std::out_of_range("simulator: there is no landmark of that index");
  }
  return true;
}

bool KinematicSimulator::path_is_clear(const Eigen::Vector2d& p_world_from, const Eigen::Vector2d& p_world_to,
                                       double radius) const {
  const Segment way{p_world_from, p_world_to};
  const double reach = 0.5 * (way.end - way.start).norm() + largest_radius_ + radius;
  return !landmarks_.any_within(0.5 * (way.start + way.end), reach,
                                [&](std::size_t landmark, const Eigen::Vector2d& p_world_landmark) {
                                  ++candidates_;
                                  return distance(way, Disk{p_world_landmark, radii_[landmark]}) <= radius;
                                });
}

SimulatorCounts KinematicSimulator::counts() const { return {steps_, 0, 0, candidates_}; }

}  // namespace sim
