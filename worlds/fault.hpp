// Faults: what goes wrong in a world on purpose, each at a given time.
#pragma once

#include <Eigen/Core>

#include "worlds/placement.hpp"

namespace worlds {

enum class FaultKind {
  bad_observation,  // one observation has an invalid value (NaN, infinite or absurd)
  outlier,          // one observation has a wrong bearing
  encoder_jump,     // one wheel's encoder jumps, and continues from the new value
  silence,          // one sensor reports nothing for some time
  kidnapping        // the robot is put somewhere else
};

enum class BadValue { nan, infinite, absurd };
enum class Wheel { left, right };
enum class FaultySensor { landmark_sensor, encoders };

/// The time of a fault, and the values that its kind uses.
struct Fault {
  FaultKind kind = FaultKind::bad_observation;
  double at = 0.0;                 // [s] it occurs at the first measurement from this time on
  BadValue value = BadValue::nan;  // bad_observation: its range
  double size = 0.0;               // [sigma] outlier: error of the bearing, counter-clockwise
  Wheel wheel = Wheel::left;       // encoder_jump
  double jump = 0.0;               // [rad] encoder_jump: of the angle that is read
  FaultySensor sensor = FaultySensor::landmark_sensor;  // silence
  double duration = 0.0;                                // [s] silence
  Placement to;                                         // kidnapping: T_world_robot
};

}  // namespace worlds
