// Degrees, for output that people read. All other angles are in radians.
#pragma once

#include <numbers>

namespace harness {

inline constexpr double degrees_per_radian = 180.0 / std::numbers::pi;  // [deg/rad]

}  // namespace harness
