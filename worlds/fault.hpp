// What goes wrong in a world on purpose, at a time.
#pragma once

#include <Eigen/Core>

#include "worlds/placement.hpp"

namespace worlds {

enum class FaultKind {
  bad_observation,  // one observation is no measurement at all
  outlier,          // one observation has a bearing that is off
  encoder_jump,     // one wheel's encoder jumps, and goes on from there
  silence,          // one sensor says nothing for a while
  kidnapping        // the robot is put somewhere else
};

enum class BadValue { nan, infinite, absurd };
enum class Wheel { left, right };
enum class FaultySensor { landmark_sensor, encoders };

/// Its time, and what its kind needs of the rest.
struct Fault {
  FaultKind kind = FaultKind::bad_observation;
  double at = 0.0;                 // [s] it comes with the first measurement from then on
  BadValue value = BadValue::nan;  // bad_observation: its range
  double size = 0.0;               // [sigma] outlier: of the bearing, counter-clockwise
  Wheel wheel = Wheel::left;       // encoder_jump
  double jump = 0.0;               // [rad] encoder_jump: of the angle as it is read
  FaultySensor sensor = FaultySensor::landmark_sensor;  // silence
  double duration = 0.0;                                // [s] silence
  Placement to;                                         // kidnapping: T_world_robot
};

}  // namespace worlds
