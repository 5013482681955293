// Faults: what goes wrong in a world on purpose, each at a given time.
#pragma once

#include <Eigen/Core>
#include <string>

#include "worlds/placement.hpp"
#include "worlds/robot.hpp"
#include "worlds/solids.hpp"

namespace worlds {

enum class FaultKind {
  bad_observation,  // one observation has an invalid value (NaN, infinite or absurd)
  outlier,          // one observation has a wrong bearing
  encoder_jump,     // one wheel's encoder jumps, and continues from the new value
  silence,          // one sensor reports nothing for some time
  kidnapping,       // the robot is put somewhere else
  ice,              // a part of the ground gets another friction
  wall,             // a wall appears
  landmark,         // a landmark appears
  option            // an option of an estimator changes
};

enum class BadValue { nan, infinite, absurd };
enum class Wheel { left, right };
enum class FaultySensor { landmark_sensor, encoders };

/// The duration of a silence that goes on until the end, or until it is ended. [s]
inline constexpr double open_end = 1e6;

/// The time of a fault, and the values that its kind uses.
struct Fault {
  FaultKind kind = FaultKind::bad_observation;
  /// In a team: the robot to which it happens; empty: it happens to every robot.
  std::string robot = {};
  double at = 0.0;                 // [s] it occurs at the first measurement or physics step from this time on
  BadValue value = BadValue::nan;  // bad_observation: its range
  double size = 0.0;               // [sigma] outlier: error of the bearing, counter-clockwise
  Wheel wheel = Wheel::left;       // encoder_jump
  double jump = 0.0;               // [rad] encoder_jump: of the angle that is read
  FaultySensor sensor = FaultySensor::landmark_sensor;  // silence
  double duration = 0.0;                                // [s] silence
  Placement to = {};                                    // kidnapping: T_world_robot
  FrictionPatch patch = {};                             // ice
  Wall wall = {};                                       // wall
  /// landmark: its id is the next free one: those of the world come first, then these in the order of time
  Landmark landmark = {};
  std::string estimator = {};  // option: the name of the estimator
  std::string option = {};     // option: its key, or a factor of the noise that the estimator assumes
  double option_value = 0.0;   // option: the new value
};

}  // namespace worlds
