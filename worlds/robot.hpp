// The robot, and the physics in which it drives. SI units and radians.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "worlds/degree.hpp"
#include "worlds/placement.hpp"

namespace worlds {

struct Caster {
  double offset = -0.18;  // [m] along the robot's x from the axle; negative is behind
  double radius = 0.04;   // [m]
};

/// A differential-drive robot: chassis, two driven wheels, a frictionless caster.
struct Robot {
  Placement start;
  double mass = 8.0;                            // [kg] of the whole robot
  double wheel_mass = 0.3;                      // [kg] of one wheel, part of `mass`
  double wheel_radius = 0.1;                    // [m]
  double track = 0.4;                           // [m] between the wheels' contact points
  double motor_torque = 2.0;                    // [N m] largest torque of one wheel's motor
  double max_speed = 1.0;                       // [m/s]
  double max_turn_rate = 90 * degree;           // [rad/s]
  double max_acceleration = 1.0;                // [m/s^2]
  double max_turn_acceleration = 240 * degree;  // [rad/s^2]
  Caster caster;
};

/// An axis-aligned rectangle of the ground with its own friction.
struct FrictionPatch {
  Eigen::Vector2d min = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d max = Eigen::Vector2d::Zero();  // [m]
  double friction = 0.1;                          // [-]
};

enum class Engine {
  bullet,     // rigid bodies: contacts, friction and slip; landmarks and obstacles block motion and sight
  kinematic,  // exact arcs without slip; landmarks are points that block nothing; no obstacles, no patches
};

struct Physics {
  Engine engine = Engine::bullet;
  int step_rate = 240;                 // [Hz]
  double friction = 0.9;               // [-] Coulomb coefficient between wheels and ground
  std::vector<FrictionPatch> patches;  // where patches overlap, the later one counts
};

}  // namespace worlds
