// How far and how wide the robot has seen so far.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>

#include "seif/types.hpp"

namespace seif {

class SensorView {
 public:
  void widen(std::span<const Observation> observations) {
    for (const Observation& z : observations) {
      reach_ = std::max(reach_, z.range);
      widest_bearing_ = std::max(widest_bearing_, std::abs(z.bearing));
    }
  }

  double reach() const { return reach_; }                    // [m]
  double widest_bearing() const { return widest_bearing_; }  // [rad]

  /// Whether something at p_sensor [m] is no farther away than `range` [m], and no farther to the side than `bearing` [rad].
  static bool is_within(const Eigen::Vector2d& p_sensor, double range, double bearing) {
    return p_sensor.norm() <= range && std::abs(std::atan2(p_sensor.y(), p_sensor.x())) <= bearing;
  }

 private:
  double reach_ = 0.0, widest_bearing_ = 0.0;
};

}  // namespace seif
